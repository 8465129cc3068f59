#pragma once
// On which side of a kink a motion begins: k*(x0 - a) is k*abs(x0 - a) where a < x0, which the formula has to
// say.

#include <optional>
#include <string>
#include <vector>

#include "core/closed/turning_equation.hpp"

namespace qdot {

/// What a constant of the motion assumes beside `assumes`, so that the formula is `e` there; none where no
/// side that was taken tells.
[[nodiscard]] std::optional<std::vector<std::string>> sides_of_constant(
    const TurningEquation& equation, const Expression& e, const Expression& formula,
    const Relations& relations, const std::vector<std::string>& assumes);

/// The same of `formula` = 0, an equation of x with the roots of `e`.
[[nodiscard]] std::optional<std::vector<std::string>> sides_of_equation(
    const TurningEquation& equation, const Expression& e, const Expression& formula,
    const Relations& relations, const std::vector<std::string>& assumes);

}  // namespace qdot
