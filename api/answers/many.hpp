#pragma once
// A request that is made of many computations, such as the rows of a sweep, spreads them over threads.

#include <cstddef>
#include <functional>

#include "api/http/messages.hpp"

namespace qdot::api {

/// Calls `task` with each of 0 to count - 1, in the threads that the request may use. Each call has its own
/// share of work (limits::algebra), so that none can take the others'. What one of them throws, such as
/// Interrupted, ends all and is thrown here.
void for_each(const Request& request, std::size_t count, const std::function<void(std::size_t)>& task);

}  // namespace qdot::api
