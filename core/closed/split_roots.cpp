#include "core/closed/split_roots.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "core/closed/linear_factors.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

class SplitRoots {
 public:
  SplitRoots(Graph& graph, const SignOf& sign) : graph_(graph), sign_(sign) {}

  /// Every root of a product of positive symbols and numbers in e; false where there are others.
  [[nodiscard]] bool take(const Expression& e) {
    std::vector<Power> powers;
    const NodeId root = e.id();
    for (const NodeId id : reachable(graph_, {&root, 1})) {
      if (std::holds_alternative<Call>(graph_.node(id))) return false;
      const auto* power = std::get_if<Power>(&graph_.node(id));
      if (power == nullptr || power->exponent.is_integer()) continue;
      if (!take_order(power->exponent)) return false;
      powers.push_back(*power);
    }
    for (const Power& power : powers) {
      const Expression base(graph_, power.base);
      const auto inside = root_of(base);
      if (!inside) return false;
      taken_.emplace_back(pow(base, power.exponent), pow(*inside, power.exponent * Number(order_)));
    }
    return symbols_.size() > 1;
  }

  [[nodiscard]] Expression with_roots_as_symbols(const Expression& e) {
    for (const auto& [symbol, root] : symbols_) taken_.emplace_back(symbol, pow(root, Number(order_)));
    return substitute(e, taken_);
  }

  [[nodiscard]] Expression with_symbols_as_roots(const Expression& e) const {
    std::vector<Replacement> back;
    for (const auto& [symbol, root] : symbols_) back.emplace_back(root, taken_root(symbol));
    return substitute(e, back);
  }

 private:
  /// Of the roots that all are powers of.
  [[nodiscard]] bool take_order(const Number& exponent) {
    constexpr std::int64_t highest = 6;
    const auto small = exponent.small();
    if (!small) return false;
    order_ = std::lcm(order_, small->denominator);
    return order_ <= highest;
  }

  [[nodiscard]] Expression taken_root(const Expression& e) const { return pow(e, Number::ratio(1, order_)); }

  /// sqrt(k1 k2/4) is s1 s2 sqrt(1/4).
  [[nodiscard]] std::optional<Expression> root_of(const Expression& base) {
    const auto [factor, exponent] = split_power(base);
    if (!exponent.is_one()) {
      const auto inside = exponent.is_integer() ? root_of(factor) : std::nullopt;
      return inside ? std::optional(pow(*inside, exponent)) : std::nullopt;
    }
    if (const Number* number = base.number())
      return number->is_negative() ? std::nullopt : std::optional(taken_root(base));
    if (std::holds_alternative<Symbol>(base.node())) return root_of_symbol(base);
    const auto* product = std::get_if<Product>(&base.node());
    if (product == nullptr || product->coefficient.is_negative()) return std::nullopt;
    const Product parts = *product;
    Expression result = taken_root(graph_.number(parts.coefficient));
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
  std::int64_t order_{1};
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
  for (const Expression& form : {lowest, simplify(lowest), with_linear_factors(lowest)}) {
    const Expression result = roots.with_symbols_as_roots(form);
    if (written_length(result) < written_length(best)) best = result;
  }
  return best;
}

}  // namespace qdot
