#pragma once
// Angles x where c0 + c1 cos(x) + c2 sin(x) vanishes, as a pendulum's ends are whose rest is not straight
// down: in a car that speeds up with a it swings from 0 to 2 atan(a/g).
//
//   c1 cos(x) + c2 sin(x) = R cos(x - b),   tan(b) = c2/c1,   x = b -+ acos(-c0/R)
//
// Of two ends one is as far from b as the other one: x = 2 b - x0.

#include <optional>
#include <vector>

#include "core/closed/exact_values.hpp"

namespace qdot {

/// Candidates, up to full turns, where neither c1 nor c2 is zero; x0 is known to be one of them.
[[nodiscard]] std::vector<Expression> tilted_angles(const Expression& e, const Expression& x,
                                                    const std::optional<Expression>& x0,
                                                    const ExactValues& values);

}  // namespace qdot
