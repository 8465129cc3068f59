#pragma once
// Where oscillations about an equilibrium that stays where it is begin to grow, and all such values were not
// searched for, as with four coordinates: between two points of a curve, one of them unstable, the condition
//
//   H_(N-1) of P(s) = det(s^2 M + s D + K), or without D the discriminant of P as a polynomial of s^2
//
// (core/steady/growing_oscillations.hpp) changes its sign, which intervals prove at both ends of what
// bisection leaves.

#include <span>
#include <vector>

#include "core/steady/branches.hpp"
#include "core/steady/critical_kinds.hpp"
#include "core/steady/critical_problem.hpp"

namespace qdot {

/// Those along `branches` that are not at one of `known`, not proven to be all; of the constant number
/// `index`. None with constraints, and of more than four coordinates.
[[nodiscard]] std::vector<KnownZero> missed_growth(const Dynamics& dynamics, const CriticalProblem& problem,
                                                   std::size_t index,
                                                   std::span<const EquilibriumBranch> branches,
                                                   std::span<const CriticalValue> known);

}  // namespace qdot
