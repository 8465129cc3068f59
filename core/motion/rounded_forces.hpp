#pragma once
// What rounding makes of the forces of a motion, as some rows show by double-doubles. Checks by Taylor's
// method bound it over each step (core/compile/taylor/rounding.hpp); one by bdf has it in common with the
// motion. There damping rules, and a force that is off by d takes a velocity d/c away,
//
//   e_v = d min(t, 1/c),   e_q = e_v t,   c = -da/dv,
//
// which is an estimate: of each coordinate by itself.

#include <vector>

#include "core/motion/computed_motion.hpp"

namespace qdot {

/// d of each acceleration, the largest.
[[nodiscard]] std::vector<double> rounding_of_forces(const ComputedMotion& motion);

/// What it may make of each column of a motion that rests, such as a ladder that friction holds: of
/// velocities d T, of coordinates d T^2, some times over, with the largest d of their kind.
[[nodiscard]] std::vector<double> rounding_at_rest(const ComputedMotion& motion);

/// Adds it to what a check by bdf has not seen. Not where there are kinks.
void add_rounding_of_forces(const ComputedMotion& motion, Simulation& check);

}  // namespace qdot
