#pragma once
// The values of the unknown that make all forces at a position vanish, before its domain is asked: roots of a
// polynomial of degree 1 or 2, or all zeros of one force (core/numerics/root_isolation.hpp) at which the
// others vanish, too.

#include "core/steady/balance_problem.hpp"
#include "core/steady/solve_obstacles.hpp"

namespace qdot {

[[nodiscard]] Candidates balancing_values(const BalanceProblem& problem);

}  // namespace qdot
