#pragma once
// Threads for a request that is made of many (api/answers/many.hpp).

#include <functional>

#include "api/http/messages.hpp"

namespace qdot::server {

/// Whether the threads that help have the priority of heavy work (server/lanes.hpp).
enum class Help { as_it_is, beside_light_work };

/// The thread that asks and `threads` - 1 others for as long as the tasks last; each takes the next task. A
/// thread that asks and finds no more tasks calls `waits` now and then while others still compute, with the
/// seconds of a processor that these have had since the last time.
[[nodiscard]] api::Spread spread_over(
    int threads, Help help = Help::as_it_is, std::function<void(double helped)> waits = [](double) {});

}  // namespace qdot::server
