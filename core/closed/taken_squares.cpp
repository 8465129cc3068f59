#include "core/closed/taken_squares.hpp"

#include <algorithm>
#include <vector>

#include "core/expr/calculus.hpp"

namespace qdot {
bool has_roots(const Expression& e) {
  const NodeId root = e.id();
  return std::ranges::any_of(reachable(e.graph(), {&root, 1}), [&](NodeId id) {
    const auto* power = std::get_if<Power>(&e.graph().node(id));
    return power != nullptr && !power->exponent.is_integer();
  });
}

Expression with_half_powers(
    const Expression& e,
    const std::function<std::optional<Expression>(const Expression& base, const Number& exponent)>& by) {
  Graph& graph = e.graph();
  std::vector<Replacement> taken;
  const NodeId root = e.id();
  for (const NodeId id : reachable(graph, {&root, 1})) {
    const auto* power = std::get_if<Power>(&graph.node(id));
    if (power == nullptr || power->exponent.denominator() != Number(2)) continue;
    const Number exponent = power->exponent;
    if (const auto other = by(Expression(graph, power->base), exponent))
      taken.emplace_back(Expression(graph, id), *other);
  }
  return taken.empty() ? e : substitute(e, taken);
}

Expression with_squares_taken_out(const Expression& e, const SignOf& sign) {
  return with_half_powers(
      e, [&](const Expression& base, const Number& exponent) -> std::optional<Expression> {
        const Expression outside = positive_root(e.graph(), rational_function(base), sign);
        if (has_roots(outside)) return std::nullopt;
        return pow(outside, exponent * Number(2));
      });
}

}  // namespace qdot
