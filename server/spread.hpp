#pragma once
// Threads for a request that is made of many (api/answers/many.hpp).

#include "api/http/messages.hpp"

namespace qdot::server {

/// Whether the threads that help have the priority of heavy work (server/lanes.hpp).
enum class Help { as_it_is, beside_light_work };

/// The thread that asks and `threads` - 1 others for as long as the tasks last; each takes the next task.
[[nodiscard]] api::Spread spread_over(int threads, Help help = Help::as_it_is);

}  // namespace qdot::server
