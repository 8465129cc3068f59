#pragma once
// Quotients of polynomials in lowest terms: a normal form of expressions without roots.

#include "core/expr/polynomial.hpp"

namespace qdot {

/// above / below, without a common factor; the coefficients of both are whole and have no common divisor, the
/// leading one below is positive. What is no symbol - sin(x), a root - counts as one.
struct RationalFunction {
  Polynomial above;
  Polynomial below{{Monomial{}, Number(1)}};

  [[nodiscard]] bool is_zero() const { return above.empty(); }
  friend bool operator==(const RationalFunction&, const RationalFunction&) = default;
};

/// e in lowest terms. Cancelled factors are assumed not to be zero. Throws Error(too_large), and
/// Error(not_applicable) where a denominator vanishes identically.
[[nodiscard]] RationalFunction rational_function(const Expression& e);
[[nodiscard]] RationalFunction in_lowest_terms(const Polynomial& above, const Polynomial& below);

[[nodiscard]] RationalFunction operator+(const RationalFunction& a, const RationalFunction& b);
[[nodiscard]] RationalFunction operator-(const RationalFunction& a);
[[nodiscard]] RationalFunction operator-(const RationalFunction& a, const RationalFunction& b);
[[nodiscard]] RationalFunction operator*(const RationalFunction& a, const RationalFunction& b);
/// Throws Error(not_applicable) where b is zero.
[[nodiscard]] RationalFunction operator/(const RationalFunction& a, const RationalFunction& b);

/// In the shorter of two forms: one quotient, g*k/(g*m + k*l0), or a sum of them, g/l - Omega^2.
[[nodiscard]] Expression to_expression(Graph& graph, const RationalFunction& f);

}  // namespace qdot
