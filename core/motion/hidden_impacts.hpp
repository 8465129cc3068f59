#pragma once
// Impacts that nobody sees. What bounces may bounce again lower than its distance is rounded, and then
// neither the motion nor another computation of it tells on which side of the next impact a row is.

#include <span>
#include <vector>

#include "core/motion/computed_motion.hpp"
#include "core/motion/events_in_doubt.hpp"

namespace qdot {

/// Adds what such an impact changes to `check.unseen`, at those rows of motion.event_rows that fall and up to
/// which the distance has been zero, up to rounding, since the impact before.
void add_hidden_impacts(const ComputedMotion& motion, Simulation& check);

/// Impacts that may happen where the motion ends, as far as these errors of its state tell.
[[nodiscard]] std::vector<EventDoubt> impacts_at_end(const ComputedMotion& motion,
                                                     std::span<const double> errors);

/// The same of events, which are reported only.
[[nodiscard]] std::vector<EventDoubt> events_at_end(const ComputedMotion& motion,
                                                    std::span<const double> errors);

/// Impacts of which there may be more between the last one and the end than were met.
[[nodiscard]] std::vector<EventDoubt> impacts_hidden_at_end(const ComputedMotion& motion);

}  // namespace qdot
