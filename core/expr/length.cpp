#include "core/expr/length.hpp"

#include <algorithm>

namespace qdot {
namespace {

/// A graph shares what a text repeats, so lengths grow like 2^depth. Far beyond everything that is ever
/// compared they stop growing.
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

Length of_product(const Product& product, const std::deque<Node>& nodes, const std::vector<Length>& lengths) {
  const bool bare = product.coefficient.is_one() || product.coefficient == Number(-1);
  Length sum{product.factors.size() - (bare ? 1 : 0), product.coefficient.is_integer() ? 0U : 1U};
  for (const NodeId id : product.factors) {
    const auto* power = std::get_if<Power>(&nodes[id]);
    const bool quotient = power != nullptr && power->exponent == Number(-1);
    add(sum, lengths[quotient ? power->base : id]);
  }
  return sum;
}

}  // namespace

Length length_of(const Node& node, const std::deque<Node>& nodes, const std::vector<Length>& lengths) {
  return std::visit(overloaded{[](const Literal& x) {
                                 return Length{0, x.value.is_integer() ? 0U : 1U};
                               },
                               [](const Symbol&) { return Length{}; },
                               [&](const Sum& x) {
                                 Length sum{x.terms.size() - 1, 0};
                                 for (const NodeId id : x.terms) add(sum, lengths[id]);
                                 return sum;
                               },
                               [&](const Product& x) { return of_product(x, nodes, lengths); },
                               [&](const Power& x) { return with(1, lengths[x.base]); },
                               [&](const Call& x) { return with(1, lengths[x.argument]); }},
                    node);
}

}  // namespace qdot
