#pragma once
// Periods between walls that give back all of the speed, or one and a turning point, as formulas: 2
// sqrt(2h/g) of a ball that bounces from h, 2 l/v between two walls, pi sqrt(m/k) on a spring with a wall in
// the middle.

#include <optional>
#include <vector>

#include "core/closed/elementary_period.hpp"

namespace qdot {

/// Candidates, which have to be held against the number: of a constant inertia, and a potential of the second
/// degree at most. `below` and `above`: the places of the walls there are.
[[nodiscard]] std::vector<Expression> elastic_periods(const QuadratureProblem& problem,
                                                      const std::optional<Expression>& below,
                                                      const std::optional<Expression>& above,
                                                      const ExactValues& values);

}  // namespace qdot
