#include "core/expr/full_turn.hpp"

#include <optional>
#include <set>

namespace qdot {
namespace {

/// k where u = k x + c and c does not contain x.
std::optional<Number> linear_coefficient(const Expression& u, const Expression& x) {
  if (u == x) return Number(1);
  if (!depends_on(u, x)) return Number(0);
  if (const auto* product = std::get_if<Product>(&u.node()); product && product->factors.size() == 1) {
    const auto inner = linear_coefficient({u.graph(), product->factors[0]}, x);
    return inner ? std::optional(product->coefficient * *inner) : std::nullopt;
  }
  const auto* sum = std::get_if<Sum>(&u.node());
  if (sum == nullptr) return std::nullopt;
  Number total(0);
  for (const NodeId id : sum->terms) {
    const auto term = linear_coefficient({u.graph(), id}, x);
    if (!term) return std::nullopt;
    total = total + *term;
  }
  return total;
}

bool is_circular(Function function) {
  return function == Function::sin || function == Function::cos || function == Function::tan;
}

}  // namespace

bool has_full_turn(const Expression& e, const Expression& x) {
  Graph& graph = e.graph();
  std::set<NodeId> seen;
  std::vector<NodeId> left{e.id()};
  while (!left.empty()) {
    const NodeId id = left.back();
    left.pop_back();
    if (id == x.id()) return false;
    if (!seen.insert(id).second) continue;
    const auto* call = std::get_if<Call>(&graph.node(id));
    if (call != nullptr && is_circular(call->function)) {
      const auto k = linear_coefficient({graph, call->argument}, x);
      if (k && k->is_integer()) continue;
    }
    for (const NodeId child : children(graph.node(id))) left.push_back(child);
  }
  return true;
}

}  // namespace qdot
