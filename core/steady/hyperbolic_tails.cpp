#include "core/steady/hyperbolic_tails.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "core/expr/polynomial.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

/// tanh^2 u, written so or as sinh^2 u/cosh^2 u, and cosh u.
struct Tail {
  Monomial square;
  NodeId cosh;
};

std::vector<Tail> tails_of(const Expression& e) {
  std::vector<Tail> found;
  const NodeId root[]{e.id()};
  Graph& graph = e.graph();
  for (const NodeId id : reachable(graph, root)) {
    const auto* call = std::get_if<Call>(&graph.node(id));
    if (call == nullptr) continue;
    const Function function = call->function;
    if (function != Function::tanh && function != Function::sinh) continue;
    const NodeId cosh = graph.call(Function::cosh, {graph, call->argument}).id();
    const Monomial square = times({}, id, 2);
    found.push_back({function == Function::tanh ? square : times(square, cosh, -2), cosh});
  }
  return found;
}

Number size_of(const Number& x) { return x.is_negative() ? -x : x; }

/// c m + d m tanh^2 with c and d of opposite signs: the smaller of them times m/cosh^2, and what is left.
bool join_one(Polynomial& polynomial, const Tail& tail) {
  for (const auto& [monomial, coefficient] : polynomial) {
    const auto other = polynomial.find(monomial * tail.square);
    if (other == polynomial.end() || coefficient.is_negative() == other->second.is_negative()) continue;
    const Number c = size_of(other->second) < size_of(coefficient) ? -other->second : coefficient;
    const Monomial lower = monomial, upper = other->first;
    add(polynomial, lower, -c);
    add(polynomial, upper, c);
    add(polynomial, times(lower, tail.cosh, -2), c);
    return true;
  }
  return false;
}

}  // namespace

Expression with_hyperbolic_tails(const Expression& e) {
  const std::vector<Tail> tails = tails_of(e);
  if (tails.empty()) return e;
  Polynomial polynomial = multiplied_out(e);
  bool is_new = false;
  for (const Tail& tail : tails) {
    while (join_one(polynomial, tail)) is_new = true;
  }
  return is_new ? simplify(to_expression(e.graph(), polynomial)) : e;
}

}  // namespace qdot
