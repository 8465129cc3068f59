#pragma once
// Events whose functions are rounded by as much as they change along a motion: (x + 1e9)^2 - 1e18 - 2e9 x is
// x^2, but only the last digits of 1e18 show it. No computation in doubles finds how often such an event
// happens. Nor does one where the errors of the motion change the event's function by a large part.

#include <optional>
#include <span>
#include <vector>

#include "core/motion/events_in_doubt.hpp"
#include "core/motion/measured_simulation.hpp"
#include "core/motion/motion_check.hpp"

namespace qdot {

/// Of at most 16 rows, one is judged: where the event's function is largest. This is a hint to the reader;
/// the errors of instants do not rest on it.
[[nodiscard]] std::vector<EventDoubt> events_lost_in_rounding(const ComputedMotion& motion);
/// Events whose functions have no visible sign up to the end, or to an impact.
[[nodiscard]] std::vector<EventDoubt> events_hidden_by_rounding(const ComputedMotion& motion);
/// Events whose functions the given errors of the coordinates and velocities change by a large part.
[[nodiscard]] std::vector<EventDoubt> events_lost_in_errors(const ComputedMotion& motion,
                                                            std::span<const double> errors);
/// Events that may happen several times within the error of one crossing's time. `errors`: of the events.
[[nodiscard]] std::vector<EventDoubt> events_that_may_be_several(
    const ComputedMotion& motion, std::span<const std::optional<EventError>> errors);

}  // namespace qdot
