#pragma once
// Events whose functions are rounded by as much as they change along a motion: (x + 1e9)^2 - 1e18 - 2e9 x is
// x^2, but all that is seen of it are last digits of 1e18. How often such a one happens no computation tells.
// The same of events whose functions the errors of a motion change by much of what they are.

#include <optional>
#include <span>
#include <vector>

#include "core/motion/events_in_doubt.hpp"
#include "core/motion/measured_simulation.hpp"
#include "core/motion/motion_check.hpp"

namespace qdot {

/// Each such event that is seen. Each is judged at one row, that of at most
/// 16 at which its function is largest: a hint beside the errors of the instants, which do not rest on it.
[[nodiscard]] std::vector<EventDoubt> events_lost_in_rounding(const ComputedMotion& motion);
/// Those whose sign was not seen up to the end, or to an impact.
[[nodiscard]] std::vector<EventDoubt> events_hidden_by_rounding(const ComputedMotion& motion);
[[nodiscard]] std::vector<EventDoubt> events_lost_in_errors(const ComputedMotion& motion,
                                                            std::span<const double> errors);
/// Those that may happen several times within the error of one crossing's time. `errors`: of the motion's
/// events.
[[nodiscard]] std::vector<EventDoubt> events_that_may_be_several(
    const ComputedMotion& motion, std::span<const std::optional<EventError>> errors);

}  // namespace qdot
