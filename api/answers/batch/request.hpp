#pragma once
// /v1/batch: many requests in one, a line each (line.hpp), and as many lines of answers in the same order.

#include <span>

#include "api/answers/endpoint.hpp"

namespace qdot::api {

/// `asked` are the endpoints that a line may ask; they live as long as the program.
[[nodiscard]] Endpoint batch_endpoint(std::span<const Endpoint> asked);

}  // namespace qdot::api
