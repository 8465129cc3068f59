#pragma once
// Polynomials with rational coefficients whose roots are p + 2 q cos(2 pi j/N): those of chains and rings of
// equal masses, whose rates are 2 sqrt(k/m) sin(j pi/(2 (n + 1))) (Marion, Thornton, Classical
// Dynamics, 12.9).

#include <vector>

#include "core/expr/expression.hpp"

namespace qdot {

/// Of c0 + c1 x + c2 x^2 + ..., those roots that are found so, of factors of the third degree and more; as
/// 4 q sin(r pi)^2 where p = 2 q.
[[nodiscard]] std::vector<Expression> cosine_roots(Graph& graph, std::vector<Number> c);

}  // namespace qdot
