#pragma once
// Short factored forms of multiplied-out expressions.

#include "core/expr/polynomial.hpp"

namespace qdot {

/// An expression equal to the polynomial with few operations: common factors and squares taken out, the rest
/// grouped by the factor that most terms share, a bracket that divides the rest shared with it. A factor in front
/// of terms with unlike rational coefficients is taken out only where that spares at least four operations, as
/// textbooks do: 1/2 m W^2 q^2 + 3/4 m r^2 W^2 stays, m l^2 (2/3 a^2 + 1/2 b^2 + a b) does not.
[[nodiscard]] Expression factored(Graph& graph, const Polynomial& polynomial);

}  // namespace qdot
