#include "core/closed/joined_numbers.hpp"

#include <algorithm>

namespace qdot {
namespace {

const Number* number_of(const Graph& graph, const Atom& atom) {
  const auto* literal = std::get_if<Literal>(&graph.node(atom.base));
  return literal == nullptr || literal->value.is_zero() ? nullptr : &literal->value;
}

/// 3^(5/2) is 9 3^(1/2): the whole powers are taken out.
Polynomial joined(const Graph& graph, const Polynomial& a) {
  Polynomial result;
  for (const auto& [monomial, coefficient] : a) {
    Number front = coefficient;
    Monomial rest;
    for (const Atom& atom : monomial) {
      const Number* base = number_of(graph, atom);
      if (base == nullptr) {
        rest.push_back(atom);
        continue;
      }
      const int part = ((atom.p % atom.q) + atom.q) % atom.q;
      front = front * power(*base, (atom.p - part) / atom.q);
      if (part != 0) rest.push_back({atom.base, part, atom.q});
    }
    add(result, rest, front);
  }
  return result;
}

RationalFunction joined(const Graph& graph, const RationalFunction& f) {
  return in_lowest_terms(joined(graph, f.above), joined(graph, f.below));
}

bool has_numbers(const Graph& graph, const Polynomial& a) {
  return std::ranges::any_of(a, [&](const auto& term) {
    return std::ranges::any_of(term.first,
                               [&](const Atom& atom) { return number_of(graph, atom) != nullptr; });
  });
}

}  // namespace

Polynomial joined_numbers(const Graph& graph, const Polynomial& a) {
  return has_numbers(graph, a) ? joined(graph, a) : a;
}

Surd joined_numbers(const Graph& graph, const Surd& x) {
  const auto parts = {&x.p.above, &x.p.below, &x.q.above, &x.q.below, &x.n};
  if (std::ranges::none_of(parts, [&](const Polynomial* part) { return has_numbers(graph, *part); }))
    return x;
  const Surd rational = joined(graph, x.p);
  if (x.is_rational()) return rational;
  const RationalFunction radicand = joined(graph, RationalFunction{x.n});
  return rational + Surd(joined(graph, x.q)) * square_root(radicand);
}

}  // namespace qdot
