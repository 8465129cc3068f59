#pragma once
// 1 - tanh^2 u = 1/cosh^2 u has no zero, and 1 - tanh^2 u has lost its sign where tanh u rounds to 1.

#include "core/expr/expression.hpp"

namespace qdot {

/// An equal expression: pairs of terms such as 2 tanh u - 2 tanh^3 u are made one, 2 tanh u/cosh^2 u;
/// with sinh u/cosh u for tanh u, too.
[[nodiscard]] Expression with_hyperbolic_tails(const Expression& e);

}  // namespace qdot
