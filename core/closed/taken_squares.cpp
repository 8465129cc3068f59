#include "core/closed/taken_squares.hpp"

#include <algorithm>
#include <vector>

#include "core/expr/calculus.hpp"

namespace qdot {
namespace {

bool still_has_roots(const Expression& e) {
  const NodeId root = e.id();
  return std::ranges::any_of(reachable(e.graph(), {&root, 1}), [&](NodeId id) {
    const auto* power = std::get_if<Power>(&e.graph().node(id));
    return power != nullptr && !power->exponent.is_integer();
  });
}

}  // namespace

Expression with_squares_taken_out(const Expression& e, const SignOf& sign) {
  Graph& graph = e.graph();
  std::vector<Replacement> taken;
  const NodeId root = e.id();
  for (const NodeId id : reachable(graph, {&root, 1})) {
    const auto* power = std::get_if<Power>(&graph.node(id));
    if (power == nullptr || power->exponent.denominator() != Number(2)) continue;
    const Number twice = power->exponent * Number(2);
    const Expression base(graph, power->base), outside = positive_root(graph, rational_function(base), sign);
    if (!still_has_roots(outside)) taken.emplace_back(Expression(graph, id), pow(outside, twice));
  }
  return taken.empty() ? e : substitute(e, taken);
}

}  // namespace qdot
