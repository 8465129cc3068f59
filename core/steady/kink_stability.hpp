#pragma once
// Stability of an equilibrium at kinks u_k = 0 of a potential V = V0 + sum_k c_k |u_k|, where no second
// derivative exists. With s_k the force's side (core/steady/kinks.hpp), g = dV/dx, and no other forces:
//   - one coordinate: stable where the force leads back from both sides, unstable where it leads away on one
//   - several: unstable where some c_k < 0 (the potential falls to both sides); stable where all c_k > 0 and
//     V is a minimum along the kinks, dg/dx (s fixed) positive on the v with v.du_k = 0 for all k; unstable
//     where it is negative for one of those v
//   - else undecided.
// Source: Clarke, Optimization and Nonsmooth Analysis (1990), 2.3 and 6.1; Merkin, Introduction to the Theory
// of Stability (1997), chapter 3, for the theorem of Lagrange and Dirichlet, which needs no derivative.

#include "core/numerics/root_isolation.hpp"
#include "core/steady/stability.hpp"

namespace qdot {

/// `enclosure` and `sides` are those of a SteadyState. `energy_decides`: M is positive definite and nothing
/// but the potential and damping acts; `gyroscopic`: D is not zero.
[[nodiscard]] SteadyStability stability_at_kink(const SteadyProblem& problem, const Box& enclosure,
                                                const Box& sides, bool energy_decides, bool gyroscopic);

/// At a cone to which the forces drive back from every side (core/steady/cones.hpp): a minimum of the
/// potential.
[[nodiscard]] SteadyStability stability_at_cone(bool energy_decides);

}  // namespace qdot
