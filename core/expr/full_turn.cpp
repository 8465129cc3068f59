#include "core/expr/full_turn.hpp"

#include <algorithm>
#include <map>
#include <optional>

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

/// What x -> x + 2 pi does to an expression: nothing, its sign, or something else.
enum class Turned { same, opposite, other };

Turned after_both(Turned a, Turned b) {
  if (a == Turned::other || b == Turned::other) return Turned::other;
  return a == b ? Turned::same : Turned::opposite;
}

/// Of f(u) by what becomes of u.
Turned of_function(Function function, Turned argument) {
  if (argument != Turned::opposite) return argument;
  switch (function) {
    case Function::cos:
    case Function::cosh:
    case Function::abs:
      return Turned::same;
    case Function::sin:
    case Function::tan:
    case Function::sinh:
    case Function::tanh:
    case Function::asin:
    case Function::atan:
    case Function::sign:
      return Turned::opposite;
    default:
      return Turned::other;
  }
}

/// sin(x/2) and cos(x/2) change their sign, tan(x/2) does not.
Turned of_angle(Function function, const Number& k) {
  if (k.is_integer()) return Turned::same;
  if (!(k * Number(2)).is_integer()) return Turned::other;
  return function == Function::tan ? Turned::same : Turned::opposite;
}

bool is_circular(Function function) {
  return function == Function::sin || function == Function::cos || function == Function::tan;
}

class AfterTurn {
 public:
  explicit AfterTurn(const Expression& x) : graph_(x.graph()), x_(x) {}

  Turned of(NodeId id) {
    if (const auto known = known_.find(id); known != known_.end()) return known->second;
    const Turned found = id == x_.id() ? Turned::other : of_node(graph_.node(id));
    known_.emplace(id, found);
    return found;
  }

 private:
  Turned of_node(const Node& node) {
    if (const auto* call = std::get_if<Call>(&node)) return of_call(*call);
    if (const auto* power = std::get_if<Power>(&node)) return of_power(*power);
    if (const auto* product = std::get_if<Product>(&node)) {
      Turned all = Turned::same;
      for (const NodeId factor : product->factors) all = after_both(all, of(factor));
      return all;
    }
    const auto* sum = std::get_if<Sum>(&node);
    if (sum == nullptr) return Turned::same;
    const Turned first = of(sum->terms[0]);
    const bool are_alike = std::ranges::all_of(sum->terms, [&](NodeId term) { return of(term) == first; });
    return are_alike ? first : Turned::other;
  }

  Turned of_call(const Call& call) {
    if (is_circular(call.function)) {
      const auto k = linear_coefficient({graph_, call.argument}, x_);
      if (k) return of_angle(call.function, *k);
    }
    return of_function(call.function, of(call.argument));
  }

  Turned of_power(const Power& power) {
    const Turned base = of(power.base);
    if (base != Turned::opposite || !power.exponent.is_integer())
      return base == Turned::same ? Turned::same : Turned::other;
    return (power.exponent / Number(2)).is_integer() ? Turned::same : Turned::opposite;
  }

  Graph& graph_;
  Expression x_;
  std::map<NodeId, Turned> known_;
};

}  // namespace

bool has_full_turn(const Expression& e, const Expression& x) {
  return AfterTurn(Expression(e.graph(), x.id())).of(e.id()) == Turned::same;
}

}  // namespace qdot
