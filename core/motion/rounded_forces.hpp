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

/// Adds it to what a check by bdf has not seen. Not where there are kinks.
void add_rounding_of_forces(const ComputedMotion& motion, Simulation& check);

}  // namespace qdot
