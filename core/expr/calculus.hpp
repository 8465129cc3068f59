#pragma once
// Differentiation, substitution and evaluation of expressions, each one bottom-up pass over shared nodes.

#include <span>
#include <utility>
#include <vector>

#include "core/expr/expression.hpp"

namespace qdot {

/// de/dsymbol. d|x|/dx = sign(x), dsign/dx = 0 (both right away from 0).
[[nodiscard]] Expression differentiate(const Expression& e, const Expression& symbol);

using Replacement = std::pair<Expression, Expression>;  ///< symbol, what stands in its place

/// e with every symbol replaced at once.
[[nodiscard]] Expression substitute(const Expression& e, std::span<const Replacement> replacements);

/// de/dt along a motion: sum over (x, x') of de/dx x'. A pair (t, 1) covers the explicit time.
[[nodiscard]] Expression total_derivative(const Expression& e, std::span<const Replacement> rates);

using Assignment = std::pair<Expression, double>;

/// The value of e, found by walking its nodes: slower than a compiled tape, and a check of it. Symbols
/// without a value are NaN; `pi` is known.
[[nodiscard]] double evaluate(const Expression& e, std::span<const Assignment> values);

using RealAssignment = std::pair<Expression, Real>;

/// The same with what rounding leaves out; where e has no value or its bound is not finite, the double alone.
[[nodiscard]] Real evaluate_exactly(const Expression& e, std::span<const RealAssignment> values);

/// Whether what is known of the values bounds e: tan(x) has no bound where x is pi/2 to within its error.
[[nodiscard]] bool is_bounded(const Expression& e, std::span<const RealAssignment> values);

}  // namespace qdot
