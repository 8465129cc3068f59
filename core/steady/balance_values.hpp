#pragma once
// The values of the unknown u that make all forces at a position x vanish, g_i(x, u) = 0 for every coordinate
// i. Where each g_i is a polynomial of degree 1 or 2 in u, they are the roots that all g_i have in common;
// else all zeros of one force (core/numerics/root_isolation.hpp) at which the others vanish, too. Each is an
// interval around one root. Whether the domain of u has it is asked later (core/steady/solve_for.hpp).

#include "core/steady/balance_problem.hpp"
#include "core/steady/solve_obstacles.hpp"

namespace qdot {

/// No values, and the obstacle, where there are none or where they cannot be told.
[[nodiscard]] Candidates balancing_values(const BalanceProblem& problem);

}  // namespace qdot
