#pragma once
// The zeros of a force that is no polynomial of the unknown u, over its whole domain [-L, L].
//
// From the end a of a half-line outside which the force has no value (core/steady/values_along_unknown.hpp)
// it is searched in s >= 0,
//
//   u = a + s^2,   sqrt(b (u - a)) = sqrt(b) s,
//
// in which a root is smooth and the end itself a place like others. Between two such ends each is searched
// from up to the middle.

#include "core/steady/balance_problem.hpp"
#include "core/steady/solve_obstacles.hpp"

namespace qdot {

/// Of force k.
[[nodiscard]] Candidates search_along_unknown(const BalanceProblem& problem, std::size_t k);

}  // namespace qdot
