#pragma once
// Equations of one unknown that are quadratic, or linear, in a power of it, x^n with any rational n, and
// those that become so when a square root is taken away: m g - 2 T y/sqrt(y^2 + a^2) = 0 of a weight on a
// string.

#include <optional>
#include <vector>

#include "core/expr/surd.hpp"

namespace qdot {

/// c0 + c1 u + c2 u^2 = 0 with u = x^n, n > 0; c2 may be zero.
struct QuadraticInPower {
  Number n;
  std::vector<Expression> c;
};

/// Of e = 0 without the power of x that all terms share; x stands in nothing else.
[[nodiscard]] std::optional<QuadraticInPower> quadratic_in_power(Graph& graph, const Polynomial& e,
                                                                 const Expression& x);

/// The positive root of x^n = value > 0.
[[nodiscard]] Expression root_of_power(const Expression& value, const Number& n, const SignOf& sign);

/// A^2 - C^2 B, where e = A + C sqrt(B) with a sum B that depends on x: it vanishes where e does, and
/// elsewhere.
[[nodiscard]] std::optional<Polynomial> without_square_root(Graph& graph, const Polynomial& e,
                                                            const Expression& x);

}  // namespace qdot
