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
    if (depends_on(front, variables)) return std::nullopt;
    const Expression c = simplify(to_expression(x.graph(), next->second) / front);
    if (depends_on(c, variables)) return std::nullopt;
    return moved_by(c, e, x).size() <= whole.size() ? std::optional(c) : std::nullopt;
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
