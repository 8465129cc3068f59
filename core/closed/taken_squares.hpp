#pragma once
// Squares under roots as they are with the signs at one place: k/sqrt((d - l)^2) is k/(l - d) where l > d.

#include <functional>
#include <optional>

#include "core/expr/surd.hpp"

namespace qdot {

/// Whether a power that is no whole one stands anywhere in it.
[[nodiscard]] bool has_roots(const Expression& e);

/// e with what `by` makes of base^exponent, the exponent half of an odd number, in its place; none: it stays.
[[nodiscard]] Expression with_half_powers(
    const Expression& e,
    const std::function<std::optional<Expression>(const Expression& base, const Number& exponent)>& by);

/// Roots of quotients whose square roots are quotients, too; others stay.
[[nodiscard]] Expression with_squares_taken_out(const Expression& e, const SignOf& sign);

}  // namespace qdot
