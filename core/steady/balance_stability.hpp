#pragma once
// Whether a system stays at a position that a value of the unknown holds (core/steady/stability.hpp).

#include "core/steady/balance_problem.hpp"
#include "core/steady/stability.hpp"

namespace qdot {

/// u encloses the value, `value` is the double in it that is printed.
[[nodiscard]] SteadyStability balance_stability(const BalanceProblem& problem, const Interval& u,
                                                double value);

}  // namespace qdot
