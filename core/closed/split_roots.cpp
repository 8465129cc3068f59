#include "core/closed/split_roots.hpp"

#include <algorithm>
#include <optional>

#include "core/expr/calculus.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

class SplitRoots {
 public:
  SplitRoots(Graph& graph, const SignOf& sign) : graph_(graph), sign_(sign) {}

  /// Every square root of a product of positive symbols and numbers in e; false where there are others.
  [[nodiscard]] bool take(const Expression& e) {
    const NodeId root = e.id();
    for (const NodeId id : reachable(graph_, {&root, 1})) {
      if (std::holds_alternative<Call>(graph_.node(id))) return false;
      const auto* power = std::get_if<Power>(&graph_.node(id));
      if (power == nullptr || power->exponent.is_integer()) continue;
      const Expression base(graph_, power->base);
      const Number exponent = power->exponent;
      if (!(exponent * Number(2)).is_integer()) return false;
      const auto inside = root_of(base);
      if (!inside) return false;
      taken_.emplace_back(Expression(graph_, id), pow(*inside, exponent * Number(2)));
    }
    return symbols_.size() > 1;
  }

  [[nodiscard]] Expression with_roots_as_symbols(const Expression& e) {
    for (const auto& [symbol, root] : symbols_) taken_.emplace_back(symbol, pow(root, Number(2)));
    return substitute(e, taken_);
  }

  [[nodiscard]] Expression with_symbols_as_roots(const Expression& e) const {
    std::vector<Replacement> back;
    for (const auto& [symbol, root] : symbols_) back.emplace_back(root, sqrt(symbol));
    return substitute(e, back);
  }

 private:
  /// sqrt(k1 k2/4) is s1 s2 sqrt(1/4).
  [[nodiscard]] std::optional<Expression> root_of(const Expression& base) {
    const auto [factor, exponent] = split_power(base);
    if (!exponent.is_one()) {
      const auto inside = exponent.is_integer() ? root_of(factor) : std::nullopt;
      return inside ? std::optional(pow(*inside, exponent)) : std::nullopt;
    }
    if (const Number* number = base.number())
      return number->is_negative() ? std::nullopt : std::optional(sqrt(base));
    if (std::holds_alternative<Symbol>(base.node())) return root_of_symbol(base);
    const auto* product = std::get_if<Product>(&base.node());
    if (product == nullptr || product->coefficient.is_negative()) return std::nullopt;
    const Product parts = *product;
    Expression result = sqrt(graph_.number(parts.coefficient));
    for (const NodeId id : parts.factors) {
      const auto inside = root_of({graph_, id});
      if (!inside) return std::nullopt;
      result = result * *inside;
    }
    return result;
  }

  [[nodiscard]] std::optional<Expression> root_of_symbol(const Expression& symbol) {
    const auto known = std::ranges::find(symbols_, symbol, &Replacement::first);
    if (known != symbols_.end()) return known->second;
    if (sign_(multiplied_out(symbol)) <= 0) return std::nullopt;
    symbols_.emplace_back(symbol, graph_.symbol("root of " + std::get<Symbol>(symbol.node()).name));
    return symbols_.back().second;
  }

  Graph& graph_;
  const SignOf& sign_;
  std::vector<Replacement> taken_, symbols_;
};

/// Only sums share what roots hide.
bool has_sums(const Expression& e) {
  const NodeId root = e.id();
  return std::ranges::any_of(reachable(e.graph(), {&root, 1}),
                             [&](NodeId id) { return std::holds_alternative<Sum>(e.graph().node(id)); });
}

}  // namespace

Expression with_split_roots(const Expression& e, const SignOf& sign) {
  SplitRoots roots(e.graph(), sign);
  if (!has_sums(e) || !roots.take(e)) return e;
  const Expression by_roots = roots.with_roots_as_symbols(e);
  const Expression lowest = to_expression(e.graph(), rational_function(by_roots));
  Expression best = e;
  for (const Expression& form : {lowest, simplify(lowest)}) {
    const Expression result = roots.with_symbols_as_roots(form);
    if (written_length(result) < written_length(best)) best = result;
  }
  return best;
}

}  // namespace qdot
