#include "core/steady/centred_form.hpp"

#include <algorithm>
#include <map>

#include "core/base/error.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

/// Coefficients of the powers of x; none where x stands elsewhere, too.
std::map<int, Polynomial> powers_in(const Polynomial& e, const Expression& x) {
  std::map<int, Polynomial> parts;
  for (const auto& [monomial, coefficient] : e) {
    for (const Atom& atom : monomial) {
      const Expression base(x.graph(), atom.base);
      const bool is_power_of_x = base == x && atom.p > 0 && atom.q == 1;
      if (!is_power_of_x && depends_on(base, x)) return {};
    }
    const int power = exponent_of(monomial, x.id());
    add(parts[power], times(monomial, x.id(), -power), coefficient);
  }
  return parts;
}

Polynomial moved_by(const Expression& c, const Expression& e, const Expression& x) {
  const Replacement moved{x, x + c};
  return multiplied_out(substitute(e, {&moved, 1}));
}

Number positive(const Number& number) { return number.is_negative() ? -number : number; }

/// Whether the roots of a polynomial in powers of x - c are nearer to c than that is to 0, symbols
/// being about 1: else powers of x - c cancel near 0, as of 1e-6 x^3 + x^2 + x - p, where c is -3e5.
/// Source: Fujiwara's bound, but for its factor 2.
bool are_near_middle(const std::map<int, Polynomial>& powers, const Number& c) {
  const Number reach = Number::ratio(9, 10) * positive(c);
  const auto& [degree, leading] = *powers.rbegin();
  const Number front = positive(leading.begin()->second);
  for (const auto& [exponent, part] : powers) {
    if (exponent == degree) continue;
    const Number most = front * power(reach, degree - exponent);
    if (std::ranges::any_of(part, [&](const auto& term) { return most < positive(term.second); }))
      return false;
  }
  return true;
}

}  // namespace

std::optional<Expression> middle_of_roots(const Expression& e, std::span<const Expression> variables) {
  const Expression& x = variables[0];
  try {
    const Polynomial whole = multiplied_out(e);
    const std::map<int, Polynomial> parts = powers_in(whole, x);
    if (parts.empty()) return std::nullopt;
    const auto& [degree, leading] = *parts.rbegin();
    const auto next = parts.find(degree - 1);
    if (degree < 2 || next == parts.end() || leading.size() != 1) return std::nullopt;
    const Expression front = Number(-degree) * to_expression(x.graph(), leading);
    if (front.number() == nullptr) return std::nullopt;
    const Expression c = simplify(to_expression(x.graph(), next->second) / front);
    if (c.number() == nullptr) return std::nullopt;
    const std::map<int, Polynomial> centred = powers_in(moved_by(c, e, x), x);
    return are_near_middle(centred, *c.number()) ? std::optional(c) : std::nullopt;
  } catch (const Error&) {  // the algebra grows too large
    return std::nullopt;
  }
}

Expression in_powers_from(const Expression& c, const Expression& e, const Expression& x) {
  if (!depends_on(e, x)) return e;
  try {
    if (powers_in(multiplied_out(e), x).empty()) return e;
    const Replacement back{x, x - c};
    return substitute(simplify(to_expression(x.graph(), moved_by(c, e, x))), {&back, 1});
  } catch (const Error&) {
    return e;
  }
}

}  // namespace qdot
