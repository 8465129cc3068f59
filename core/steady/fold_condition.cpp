#include "core/steady/fold_condition.hpp"

#include <algorithm>
#include <map>

#include "core/expr/calculus.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/simplify.hpp"
#include "core/steady/numerator.hpp"

namespace qdot {
namespace {

/// The powers of p in f, each with the polynomial beside it; none where p stands elsewhere, too.
std::map<int, Polynomial> parts_along(const Expression& f, const Expression& p) {
  std::map<int, Polynomial> parts;
  for (const auto& [monomial, coefficient] : multiplied_out(f)) {
    const int power = exponent_of(monomial, p.id());
    const Monomial rest = times(monomial, p.id(), -power);
    if (depends_on(to_expression(f.graph(), rest), p)) return {};
    add(parts[power], rest, coefficient);
  }
  return parts;
}

/// l^2 + x^2 with a term that knows nothing of x: parameters that are 0 are not in it.
bool is_sum_of_squares(const Expression& e, const Expression& x) {
  if (!std::holds_alternative<Sum>(e.node())) return false;
  const Polynomial terms = multiplied_out(e);
  const auto is_square = [](const auto& term) {
    return !term.second.is_negative() &&
           std::ranges::all_of(term.first, [](const Atom& a) { return a.q == 1 && a.p % 2 == 0; });
  };
  return std::ranges::all_of(terms, is_square) && std::ranges::any_of(terms, [&](const auto& term) {
           return !depends_on(to_expression(e.graph(), term.first), x);
         });
}

bool is_positive(const Expression& e, const Expression& x) {
  const auto* call = std::get_if<Call>(&e.node());
  return !depends_on(e, x) || is_sum_of_squares(e, x) ||
         (call != nullptr && (call->function == Function::exp || call->function == Function::cosh));
}

/// Where both vanish, f does for every p. b is one product: of what cannot vanish, or a power of x beside a
/// polynomial a that has a term without x.
bool have_no_common_zero(const Polynomial& a, const Polynomial& b, const Expression& x) {
  if (b.size() != 1) return false;
  const auto all_are = [&](const Monomial& monomial, const auto& wanted) {
    return std::ranges::all_of(monomial,
                               [&](const Atom& atom) { return wanted(Expression(x.graph(), atom.base)); });
  };
  const Monomial& product = b.begin()->first;
  if (all_are(product, [&](const Expression& e) { return is_positive(e, x); })) return true;
  const auto is_power = [&](const Expression& e) { return e == x || is_positive(e, x); };
  const auto is_symbolic = [&](const Expression& e) { return e == x || !depends_on(e, x); };
  const auto knows_nothing_of_x = [&](const Expression& e) { return !depends_on(e, x); };
  return all_are(product, is_power) &&
         std::ranges::all_of(a, [&](const auto& term) { return all_are(term.first, is_symbolic); }) &&
         std::ranges::any_of(a, [&](const auto& term) { return all_are(term.first, knows_nothing_of_x); });
}

}  // namespace

std::optional<Expression> fold_without_parameter(const Expression& f, const Expression& x,
                                                 const Expression& p, std::span<const Expression> variables) {
  const std::map<int, Polynomial> parts = parts_along(f, p);
  if (parts.size() != 2 || parts.begin()->first != 0) return std::nullopt;
  const Polynomial &first = parts.begin()->second, &last = parts.rbegin()->second;
  if (!have_no_common_zero(first, last, x)) return std::nullopt;
  const Expression a = to_expression(f.graph(), first), b = to_expression(f.graph(), last);
  return simplify(numerator_of(b * differentiate(a, x) - a * differentiate(b, x), variables));
}

}  // namespace qdot
