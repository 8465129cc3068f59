#pragma once
// Expressions multiplied out: sums of coefficient times monomial.

#include <optional>
#include <vector>

#include "core/expr/expression.hpp"
#include "core/expr/monomial.hpp"

namespace qdot {

void add(Polynomial& sum, const Monomial& monomial, const Number& coefficient);
void add(Polynomial& sum, const Polynomial& other, const Number& factor = Number(1));
[[nodiscard]] Polynomial operator*(const Polynomial& a, const Polynomial& b);
[[nodiscard]] Polynomial scaled(const Polynomial& a, const Monomial& monomial, const Number& coefficient);

/// Throws Error(too_large) past 5,000 terms.
[[nodiscard]] Polynomial multiplied_out(const Expression& e);
[[nodiscard]] Expression to_expression(Graph& graph, const Polynomial& polynomial);
[[nodiscard]] Expression to_expression(Graph& graph, const Monomial& monomial);
/// What is added up in e, multiplied out: x (y + 2) has x y and 2 x.
[[nodiscard]] std::vector<Expression> terms_of(const Expression& e);
/// There and back: e as a sum of products, like terms collected. Exact.
[[nodiscard]] Expression expand(const Expression& e);

/// The largest monomial that all terms share: x^2 y + x^3 -> x^2; only what every term has in its numerator,
/// or every term in its denominator.
[[nodiscard]] Monomial common_monomial(const Polynomial& polynomial);

/// a / b when that is a polynomial again.
[[nodiscard]] std::optional<Polynomial> exact_quotient(const Polynomial& a, const Polynomial& b);

/// s with s^2 = a and a positive leading coefficient, when there is one.
[[nodiscard]] std::optional<Polynomial> exact_root(const Polynomial& a);

}  // namespace qdot
