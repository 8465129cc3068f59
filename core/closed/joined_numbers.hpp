#pragma once
// Numbers among the factors of polynomials: the products of roots such as sqrt(3) leave whole powers of 3
// among the symbols, so that 3*3 stands beside 9, and sqrt(9) beside 3.

#include "core/expr/surd.hpp"

namespace qdot {

/// The same with whole powers of numbers in the coefficients, and squares taken out of the root.
[[nodiscard]] Surd joined_numbers(const Graph& graph, const Surd& x);
/// The same of a polynomial.
[[nodiscard]] Polynomial joined_numbers(const Graph& graph, const Polynomial& a);

}  // namespace qdot
