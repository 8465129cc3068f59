#pragma once
// A monomial is a product of atoms (symbols, calls, sums under a root or in a denominator) with rational
// exponents of either sign; a polynomial has a coefficient for each of its monomials.

#include <map>
#include <vector>

#include "core/expr/node.hpp"

namespace qdot {

/// base^(p/q) in a monomial, p/q in lowest terms, q > 0, p != 0.
struct Atom {
  NodeId base;
  int p;
  int q;
  bool operator==(const Atom&) const = default;
};
[[nodiscard]] bool has_less_exponent(const Atom& a, const Atom& b);

/// Sorted by base, each base once.
using Monomial = std::vector<Atom>;

/// Lexicographic by exponent, bases in node order; it agrees with multiplication, so leading terms multiply.
struct LeadingFirst {
  bool operator()(const Monomial& a, const Monomial& b) const;
};

/// Coefficients by monomial, leading term first; no coefficient is zero.
using Polynomial = std::map<Monomial, Number, LeadingFirst>;

[[nodiscard]] Monomial operator*(const Monomial& a, const Monomial& b);
[[nodiscard]] Monomial inverse(const Monomial& a);
/// a with the exponent of `base` changed by p/q.
[[nodiscard]] Monomial times(const Monomial& a, NodeId base, int p, int q = 1);
/// Integer exponent of `base`: 0 when absent or fractional.
[[nodiscard]] int exponent_of(const Monomial& a, NodeId base);

}  // namespace qdot
