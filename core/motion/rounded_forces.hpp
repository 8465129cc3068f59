#pragma once
// What a check has in common with a motion: what rounding makes of the forces and of the steps. Checks by
// Taylor's method bound it over each step (core/compile/taylor/rounding.hpp, core/integrate/own_errors.hpp);
// one by bdf has it in common with the motion. There damping rules, and a force that is off by d, as some
// rows show by double-doubles, takes a velocity d/c away,
//
//   e_v = d min(t, 1/c),   e_q = e_v t,   c = -da/dv.
//
// Each of N steps rounds its sums, by half a last place u at most. Where tolerances are near round-off it
// is rounding that says which steps are tried once more, and so those that are left do not round up as often
// as down, in the motion and in its check: on the slow way along which damping lets a motion come to rest
// that adds up. By all of them, in as long as a coordinate goes one way,
//
//   e_q = N u |q| + e_v min(t, |q|/|v|),   e_v = N u |v| min(t, 1/c)/T,
//
// with the largest q and v of their kind in the motion of length T. Both are estimates: of each coordinate
// by itself.
//
// And where a motion changes by less than the tolerances of the check, such as one of nanometres with an
// absolute one of 1e-12 m, these shorten no step of either: both are off alike. Some times the check's own,
//
//   e_i = 10 (rtol |y_i| + atol),
//
// is then more than the error; beside the motion's, which are a thousand times larger, it is little.

#include <vector>

#include "core/motion/computed_motion.hpp"

namespace qdot {

/// d of each acceleration, the largest.
[[nodiscard]] std::vector<double> rounding_of_forces(const ComputedMotion& motion);

/// What it may make of each column of a motion that rests, such as a ladder that friction holds: of
/// velocities d T, of coordinates d T^2, some times over, with the largest d of their kind.
[[nodiscard]] std::vector<double> rounding_at_rest(const ComputedMotion& motion);

/// The largest magnitude of each column, and of all columns of its kind.
struct Sizes {
  std::vector<double> of_columns, of_kind;
};

/// Adds all of it to what a check by bdf with these tolerances has not seen. Not where there are kinks.
void add_what_is_in_common(const ComputedMotion& motion, const Sizes& sizes, const Tolerances& tolerances,
                           Simulation& check);

}  // namespace qdot
