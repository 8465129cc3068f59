#pragma once
// Roots of quadratic equations: p + q sqrt(n) with quotients of polynomials p and q, and n a polynomial
// without squares in its factors.

#include <functional>
#include <vector>

#include "core/expr/rational_function.hpp"

namespace qdot {

struct Surd {
  RationalFunction p, q;
  Polynomial n;  ///< irrelevant where q is zero

  Surd() = default;
  Surd(RationalFunction rational) : p(std::move(rational)) {}  // NOLINT: rational ones are surds
  Surd(RationalFunction rational, RationalFunction factor, Polynomial radicand)
      : p(std::move(rational)), q(std::move(factor)), n(std::move(radicand)) {}
  [[nodiscard]] bool is_rational() const { return q.is_zero(); }
  [[nodiscard]] bool is_zero() const { return p.is_zero() && q.is_zero(); }
};

// Of surds with the same n, or rational ones.
[[nodiscard]] Surd operator+(const Surd& a, const Surd& b);
[[nodiscard]] Surd operator-(const Surd& a);
[[nodiscard]] Surd operator-(const Surd& a, const Surd& b);
[[nodiscard]] Surd operator*(const Surd& a, const Surd& b);
/// Throws Error(not_applicable) where b is zero.
[[nodiscard]] Surd operator/(const Surd& a, const Surd& b);

/// One square root of f; the other has the other sign.
[[nodiscard]] Surd square_root(const RationalFunction& f);

/// Both x with a x^2 + b x + c = 0, one root where a is zero, none where b is zero too.
[[nodiscard]] std::vector<Surd> quadratic_roots(const RationalFunction& a, const RationalFunction& b,
                                                const RationalFunction& c);

/// sqrt(n) in short form, with a bracket that all of n shares: sqrt((m + M)*(...)); which takes long where n
/// is long: made once for all surds with this n.
[[nodiscard]] Expression root_form(Graph& graph, const Polynomial& n);

/// In short form: (17 - sqrt(217))*g/(4*l). `root`: the form of sqrt(n).
[[nodiscard]] Expression to_expression(Graph& graph, const Surd& x, const Expression& root);
[[nodiscard]] Expression to_expression(Graph& graph, const Surd& x);
/// For computing, not for reading.
[[nodiscard]] Expression plain_expression(Graph& graph, const Surd& x);

/// The sign of a polynomial where its symbols have their values: -1, 1, or 0 where it is not known.
using SignOf = std::function<int(const Polynomial&)>;

/// sqrt(x), x > 0, with squares taken out where their sign is known: 2*sqrt(g/l). The form holds where the
/// signs are the same.
[[nodiscard]] Expression positive_root(Graph& graph, const Surd& x, const Expression& root,
                                       const SignOf& sign);
[[nodiscard]] Expression positive_root(Graph& graph, const RationalFunction& x, const SignOf& sign);

}  // namespace qdot
