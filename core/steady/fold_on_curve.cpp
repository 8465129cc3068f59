#include "core/steady/fold_on_curve.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/polynomial_gcd.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {

bool has_value_everywhere(const Expression& e, std::span<const Expression> variables) {
  const NodeId root = e.id();
  return std::ranges::none_of(reachable(e.graph(), {&root, 1}), [&](NodeId id) {
    const auto* power = std::get_if<Power>(&e.graph().node(id));
    return power != nullptr && depends_on(Expression(e.graph(), power->base), variables) &&
           (power->exponent.is_negative() || !power->exponent.is_integer());
  });
}

std::optional<Expression> curve_of_line(const Expression& f, std::span<const Expression> variables) {
  const Expression& x = variables[0];
  const Expression slope = simplify(differentiate(f, x));
  if (slope.is_zero() || depends_on(slope, x)) return std::nullopt;
  const Replacement origin{x, x.graph().number(0)};
  const Expression zero = simplify(Number(-1) * substitute(f, {&origin, 1}) / slope);
  return has_value_everywhere(zero, variables) ? std::optional(zero) : std::nullopt;
}

std::optional<Expression> no_fold_on_curve(const Expression& curve, const Expression& f,
                                           std::span<const Expression> variables) {
  const auto c = curve_of_line(curve, variables);
  if (!c) return std::nullopt;
  const Replacement on_curve{variables[0], *c};
  Graph& graph = f.graph();
  try {
    const Polynomial value = multiplied_out(substitute(f, {&on_curve, 1}));
    const Polynomial slope = multiplied_out(substitute(differentiate(f, variables[0]), {&on_curve, 1}));
    if (slope.empty()) return graph.number(1);
    if (value.empty()) return std::nullopt;
    const Polynomial common = greatest_common_divisor(value, slope);
    if (!depends_on(to_expression(graph, common), variables[1])) return std::nullopt;
    const auto rest = exact_quotient(value, common);
    return rest ? std::optional(simplify(to_expression(graph, *rest))) : std::nullopt;
  } catch (const Error&) {  // the algebra grows too large
    return std::nullopt;
  }
}

}  // namespace qdot
