#include "core/expr/count.hpp"

#include <algorithm>

#include "core/expr/expression.hpp"

namespace qdot {
namespace {

/// A graph shares what a text repeats, so lengths grow like 2^depth: far beyond all that is compared they
/// stop.
constexpr std::size_t longest = 1'000'000'000;

void add(Length& sum, const Length& part) {
  sum.operations = std::min(longest, sum.operations + part.operations);
  sum.fractions = std::min(longest, sum.fractions + part.fractions);
}

Length with(std::size_t operations, const Length& part) {
  Length sum{operations, 0};
  add(sum, part);
  return sum;
}

Length of_product(const Graph& graph, const Product& product) {
  const bool bare = product.coefficient.is_one() || product.coefficient == Number(-1);
  Length sum{product.factors.size() - (bare ? 1 : 0), product.coefficient.is_integer() ? 0U : 1U};
  for (const NodeId id : product.factors) {
    const auto* power = std::get_if<Power>(&graph.node(id));
    const bool quotient = power != nullptr && power->exponent == Number(-1);
    add(sum, graph.length(quotient ? power->base : id));
  }
  return sum;
}

}  // namespace

Length length_of(const Graph& graph, const Node& node) {
  return std::visit(overloaded{[](const Literal& x) {
                                 return Length{0, x.value.is_integer() ? 0U : 1U};
                               },
                               [](const Symbol&) { return Length{}; },
                               [&](const Sum& x) {
                                 Length sum{x.terms.size() - 1, 0};
                                 for (const NodeId id : x.terms) add(sum, graph.length(id));
                                 return sum;
                               },
                               [&](const Product& x) { return of_product(graph, x); },
                               [&](const Power& x) { return with(1, graph.length(x.base)); },
                               [&](const Call& x) { return with(1, graph.length(x.argument)); }},
                    node);
}

std::size_t operation_count(const Expression& e) { return e.graph().length(e.id()).operations; }

std::size_t written_length(const Expression& e) {
  const Length length = e.graph().length(e.id());
  return 2 * length.operations + length.fractions;
}

}  // namespace qdot
