#pragma once
// Where along the unknown u the forces at a position have values: inside the half-lines of roots and
// logarithms,
//
//   sqrt(a + b u):  u >= -a/b  for b > 0,
//
// and off the zeros of what they divide by. Zeros of forces are found as those of their numerators, which may
// vanish at such a pole, too: sin(u) - u/4 does at 0, where the force sin(u)/u - 1/4 has no value.

#include "core/steady/balance_problem.hpp"
#include "core/steady/solve_obstacles.hpp"

namespace qdot {

/// Half-lines outside which a root or a logarithm of force k, of what is linear in u, has no value.
[[nodiscard]] std::vector<Interval> where_defined(const BalanceProblem& problem, std::size_t k);

/// `found`, zeros of the numerator of force k, without those that are proven to be poles. Where a pole is as
/// near as the value's error, and not proven to be the zero, the obstacle is `not_decided`.
[[nodiscard]] Candidates without_poles(const BalanceProblem& problem, Candidates found, std::size_t k);

}  // namespace qdot
