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

/// Up to an end a, or from it on: what a root or a logarithm in a force, of what is linear in u, leaves it.
struct HalfLine {
  Expression argument, slope, end;  ///< argument = slope (u - end)
  Interval place;                   ///< of the end
  int direction{};                  ///< of the half-line from there: 1 or -1
};

/// Those of force k, in `graph`, a copy of the polynomial's.
[[nodiscard]] std::vector<HalfLine> half_lines(const BalanceProblem& problem, Graph& graph, std::size_t k);
/// Whether it has a value only in a part of the line that they do not tell, as sqrt(1 - u^2) has.
[[nodiscard]] bool has_other_ends(const BalanceProblem& problem, std::size_t k);

/// `found`, zeros of the numerator of force k, without those that are proven to be poles. Where a pole is as
/// near as the value's error, and not proven to be the zero, the obstacle is `not_decided`.
[[nodiscard]] Candidates without_poles(const BalanceProblem& problem, Candidates found, std::size_t k);

}  // namespace qdot
