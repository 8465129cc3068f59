#pragma once
// Impacts that nobody sees. What bounces may bounce again lower than its distance is rounded, and then
// neither the motion nor another computation of it tells on which side of the next impact a row is.

#include "core/motion/computed_motion.hpp"

namespace qdot {

/// Adds what such an impact changes to `check.unseen`: at rows, which are those of motion.event_rows, up to
/// which the distance is zero but for rounding since the impact before, and that fall.
void add_hidden_impacts(const ComputedMotion& motion, Simulation& check);

}  // namespace qdot
