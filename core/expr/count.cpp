#include "core/expr/count.hpp"

#include <map>

namespace qdot {
namespace {

std::size_t count(const Graph& graph, NodeId id, std::map<NodeId, std::size_t>& done);

std::size_t count_terms(const Graph& graph, const Sum& sum, std::map<NodeId, std::size_t>& done) {
  std::size_t operations = sum.terms.size() - 1;
  for (const NodeId id : sum.terms) operations += count(graph, id, done);
  return operations;
}

std::size_t count_factors(const Graph& graph, const Product& product, std::map<NodeId, std::size_t>& done) {
  const bool bare = product.coefficient.is_one() || product.coefficient == Number(-1);
  std::size_t operations = product.factors.size() - (bare ? 1 : 0);
  for (const NodeId id : product.factors) {
    const auto* power = std::get_if<Power>(&graph.node(id));
    const bool quotient = power != nullptr && power->exponent == Number(-1);
    operations += quotient ? count(graph, power->base, done) : count(graph, id, done);
  }
  return operations;
}

std::size_t count(const Graph& graph, NodeId id, std::map<NodeId, std::size_t>& done) {
  const auto found = done.find(id);
  if (found != done.end()) return found->second;
  const std::size_t operations = std::visit(
      overloaded{[](const Literal&) { return std::size_t{0}; }, [](const Symbol&) { return std::size_t{0}; },
                 [&](const Sum& x) { return count_terms(graph, x, done); },
                 [&](const Product& x) { return count_factors(graph, x, done); },
                 [&](const Power& x) { return 1 + count(graph, x.base, done); },
                 [&](const Call& x) { return 1 + count(graph, x.argument, done); }},
      graph.node(id));
  done.emplace(id, operations);
  return operations;
}

bool is_fraction(const Node& node) {
  if (const auto* literal = std::get_if<Literal>(&node)) return !literal->value.is_integer();
  if (const auto* product = std::get_if<Product>(&node)) return !product->coefficient.is_integer();
  return false;
}

}  // namespace

std::size_t operation_count(const Expression& e) {
  std::map<NodeId, std::size_t> done;
  return count(e.graph(), e.id(), done);
}

std::size_t written_length(const Expression& e) {
  const NodeId root[]{e.id()};
  std::size_t fractions = 0;
  for (const NodeId id : reachable(e.graph(), root)) {
    if (is_fraction(e.graph().node(id))) ++fractions;
  }
  return 2 * operation_count(e) + fractions;
}

}  // namespace qdot
