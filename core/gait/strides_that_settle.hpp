#pragma once
// Gaits that attract are where strides lead: u, P(u), P(P(u)), ... from the motion with which the scene
// starts, or from that with other velocities. No curve needs to lead there (core/gait/gait_search.hpp), nor
// need the stride be short: a wheel that all but stops on a spoke rolls on like any other.

#include <functional>
#include <optional>
#include <vector>

#include "core/gait/shooting.hpp"

namespace qdot {

/// How many crossings the gait near a candidate ignores (Stride), if there is one. The search goes on with
/// other starts until there is one that ignores none, or that attracts the scene's own motion.
using IgnoredByGait = std::function<std::optional<int>(const Recurrence&)>;

/// Follows impact after impact from the scene's start, its velocities `haste` times as large. Places at which
/// strides hardly change any more are shown to `gait_near`, unless they are near one of `known`; returns the
/// first that is a gait.
[[nodiscard]] std::optional<Recurrence> where_strides_settle(SectionMap& map, double haste,
                                                             const std::vector<Recurrence>& known,
                                                             const IgnoredByGait& gait_near);

}  // namespace qdot
