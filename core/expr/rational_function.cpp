#include "core/expr/rational_function.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/expr/factored_form.hpp"
#include "core/expr/polynomial_gcd.hpp"

namespace qdot {
namespace {

/// The least exponents of everything with negative ones, turned around.
Monomial denominator_of(const Polynomial& a) {
  std::map<NodeId, Atom> least;
  for (const auto& [monomial, coefficient] : a) {
    for (const Atom& atom : monomial) {
      if (atom.p >= 0) continue;
      Atom& found = least.try_emplace(atom.base, atom).first->second;
      if (atom.p * found.q < found.p * atom.q) found = atom;
    }
  }
  Monomial result;
  for (const auto& [base, atom] : least) result.push_back({base, -atom.p, atom.q});
  return result;
}

Polynomial opened(Graph& graph, const Polynomial& a) { return multiplied_out(to_expression(graph, a)); }

/// What is below in the terms of a, brackets opened, until nothing is.
RationalFunction cleared(Graph& graph, Polynomial above) {
  Polynomial below{{Monomial{}, Number(1)}};
  for (Monomial front = denominator_of(above); !front.empty(); front = denominator_of(above)) {
    above = opened(graph, scaled(above, front, Number(1)));
    below = below * multiplied_out(to_expression(graph, front));
  }
  for (Monomial front = denominator_of(below); !front.empty(); front = denominator_of(below)) {
    above = opened(graph, scaled(above, front, Number(1)));
    below = opened(graph, scaled(below, front, Number(1)));
  }
  return {std::move(above), std::move(below)};
}

/// With what all terms share in front, l1 l2 (4 m1 + 3 m2): a quotient is read by its factors.
Expression by_factors(Graph& graph, const Polynomial& a) {
  const Monomial front = common_monomial(a);
  const Polynomial bracket = scaled(a, inverse(front), Number(1));
  return to_expression(graph, front) * factored_form(graph, bracket);
}

/// Without a minus in front that the denominator can take: 3 g/(3 r - 2 a) for -3 g/(2 a - 3 r).
RationalFunction with_positive_front(const RationalFunction& f) {
  const auto negative = [](const auto& term) { return term.second.is_negative(); };
  const bool is_turned = std::ranges::all_of(f.above, negative) && std::ranges::any_of(f.below, negative);
  if (!is_turned) return f;
  return {scaled(f.above, {}, Number(-1)), scaled(f.below, {}, Number(-1))};
}

}  // namespace

RationalFunction in_lowest_terms(const Polynomial& above, const Polynomial& below) {
  if (below.empty()) throw Error(ErrorCode::not_applicable, "A denominator vanishes identically.");
  if (above.empty()) return {};
  Monomial front = denominator_of(below) * denominator_of(above);
  RationalFunction result{scaled(above, front, Number(1)), scaled(below, front, Number(1))};
  Monomial shared;
  for (const Atom& a : common_monomial(result.above)) {
    for (const Atom& b : common_monomial(result.below)) {
      if (a.base == b.base) shared.push_back(a.p * b.q < b.p * a.q ? a : b);
    }
  }
  result = {scaled(result.above, inverse(shared), Number(1)),
            scaled(result.below, inverse(shared), Number(1))};
  const Polynomial common = greatest_common_divisor(result.above, result.below);
  if (common.size() > 1)
    result = {*exact_quotient(result.above, common), *exact_quotient(result.below, common)};
  const Number ratio = content(result.above) / content(result.below);
  const Number sign(result.below.begin()->second.is_negative() ? -1 : 1);
  return {scaled(result.above, {}, sign * ratio.numerator() / content(result.above)),
          scaled(result.below, {}, sign * ratio.denominator() / content(result.below))};
}

RationalFunction rational_function(const Expression& e) {
  const RationalFunction raw = cleared(e.graph(), multiplied_out(e));
  return in_lowest_terms(raw.above, raw.below);
}

RationalFunction operator+(const RationalFunction& a, const RationalFunction& b) {
  Polynomial above = a.above * b.below;
  add(above, b.above * a.below);
  return in_lowest_terms(above, a.below * b.below);
}

RationalFunction operator-(const RationalFunction& a) { return {scaled(a.above, {}, Number(-1)), a.below}; }

RationalFunction operator-(const RationalFunction& a, const RationalFunction& b) { return a + -b; }

RationalFunction operator*(const RationalFunction& a, const RationalFunction& b) {
  return in_lowest_terms(a.above * b.above, a.below * b.below);
}

RationalFunction operator/(const RationalFunction& a, const RationalFunction& b) {
  return in_lowest_terms(a.above * b.below, a.below * b.above);
}

Expression to_expression(Graph& graph, const RationalFunction& f) {
  if (f.is_zero()) return graph.number(0);
  const RationalFunction turned = with_positive_front(f);
  const Expression quotient = by_factors(graph, turned.above) / by_factors(graph, turned.below);
  if (f.below.size() > 1) return quotient;
  const Polynomial terms =
      scaled(f.above, inverse(f.below.begin()->first), Number(1) / f.below.begin()->second);
  const Expression sum = to_expression(graph, terms);
  return written_length(sum) < written_length(quotient) ? sum : quotient;
}

}  // namespace qdot
