#include "core/expr/unfold.hpp"

#include <algorithm>
#include <optional>

#include "core/expr/kept_terms.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_arguments_compared = 8;  ///< arguments

bool is_kink(const Node& node) {
  const auto* call = std::get_if<Call>(&node);
  return call != nullptr && (call->function == Function::abs || call->function == Function::sign);
}

class Unfolding {
 public:
  Unfolding(Graph& graph, std::span<const Expression> variables) : graph_(graph), variables_(variables) {}

  Unfolded run(std::span<const Expression> expressions) {
    std::vector<NodeId> roots;
    for (const Expression& e : expressions) roots.push_back(e.id());
    for (const NodeId id : reachable(graph_, roots)) {  // what is inside comes first
      if (!depends_on(Expression(graph_, id), variables_)) continue;
      if (is_kink(graph_.node(id))) unfold(id);
      if (const auto* power = std::get_if<Power>(&graph_.node(id))) unfold(id, *power);
    }
    for (const Expression& e : expressions) result_.smooth.push_back(without_even_powers(smooth(e)));
    return std::move(result_);
  }

 private:
  [[nodiscard]] Expression smooth(const Expression& e) const {
    return result_.replacements.empty() ? e : substitute(e, result_.replacements);
  }

  void unfold(NodeId id) {
    const Expression inside(graph_, std::get<Call>(graph_.node(id)).argument);
    const Argument argument = argument_of(inside);
    const Expression side = side_of(argument);
    result_.replacements.emplace_back(graph_.call(Function::abs, inside), side * argument.computed);
    result_.replacements.emplace_back(graph_.call(Function::sign, inside), side);
  }

  /// |u|^p has no kink for p > 1, and is real only of |u| itself; (u^2)^(p/2) is |u|^p.
  void unfold(NodeId id, Power power) {
    if (power.exponent.is_integer()) return;
    const auto* call = std::get_if<Call>(&graph_.node(power.base));
    if (call != nullptr && call->function == Function::abs) {
      const Expression size = graph_.call(Function::abs, smooth({graph_, call->argument}));
      result_.replacements.emplace_back(Expression(graph_, id), pow(size, power.exponent));
    }
    if (is_even_power(power.base))
      result_.replacements.emplace_back(Expression(graph_, id), size_of(power.base, power.exponent));
    if (std::holds_alternative<Product>(graph_.node(power.base))) unfold_product(id, power);
  }

  [[nodiscard]] bool is_even_power(NodeId id) const {
    const auto* power = std::get_if<Power>(&graph_.node(id));
    return power != nullptr && (power->exponent * Number::ratio(1, 2)).is_integer();
  }

  /// |u|^(p q) for the even power u^p.
  [[nodiscard]] Expression size_of(NodeId even_power, const Number& q) {
    const Power inner = std::get<Power>(graph_.node(even_power));
    const Argument base = argument_of({graph_, inner.base});
    const Number exponent = inner.exponent * q;
    const Expression size =
        exponent.is_integer() ? side_of(base) * base.computed : graph_.call(Function::abs, base.computed);
    return pow(size, exponent);
  }

  /// (c u^2)^(1/2) is c^(1/2) |u| where c is constant: it has no value for c < 0.
  void unfold_product(NodeId id, const Power& power) {
    const Product product = std::get<Product>(graph_.node(power.base));
    Expression constant = graph_.number(product.coefficient), sizes = graph_.number(1);
    for (const NodeId factor : product.factors) {
      const bool varies = depends_on(Expression(graph_, factor), variables_);
      if (varies && !is_even_power(factor)) return;
      if (!varies) constant = constant * Expression(graph_, factor);
    }
    for (const NodeId factor : product.factors) {
      if (depends_on(Expression(graph_, factor), variables_)) sizes = sizes * size_of(factor, power.exponent);
    }
    result_.replacements.emplace_back(Expression(graph_, id), pow(constant, power.exponent) * sizes);
  }

  /// In its short form, by which it is known again, and as it is computed, which keeps its digits.
  struct Argument {
    Expression short_form, computed;
  };
  [[nodiscard]] Argument argument_of(const Expression& inside) const {
    const Expression written = smooth(inside);
    const Expression short_form = simplify(written);
    const bool loses_digits = loses_digits_multiplied_out(graph_.call(Function::abs, written));
    return {short_form, loses_digits ? written : short_form};
  }

  /// c rest for a sum of c_v v over the variables with c_v = c by a number, where c is a sum that may be 0:
  /// then nothing is left of the kink, and its argument says nothing of where it is.
  struct Factored {
    Expression factor, rest;
  };
  [[nodiscard]] std::optional<Factored> cancelling_factor(const Expression& u) const {
    std::optional<Expression> factor;
    Expression rest = graph_.number(0);
    for (const Expression& variable : variables_) {
      const Expression slope = simplify(differentiate(u, variable));
      if (slope.is_zero()) continue;
      if (!factor) factor = slope;
      const Expression ratio = simplify(slope / *factor);
      if (!std::holds_alternative<Sum>(factor->node()) || ratio.number() == nullptr) return std::nullopt;
      rest = rest + ratio * variable;
    }
    const bool varies = !factor || depends_on(*factor, variables_) || depends_on(*factor, graph_.symbol("t"));
    if (varies || !simplify(u - *factor * rest).is_zero()) return std::nullopt;
    return Factored{*factor, rest};
  }

  /// The same for every multiple of one argument, but for the sign of the factor.
  Expression side_of(const Argument& argument) {
    if (const auto factored = cancelling_factor(argument.short_form))
      return sign_of(factored->factor) * side_of({factored->rest, factored->rest});
    const Scaled scaled = split_coefficient(argument.short_form);
    const bool opposite = scaled.coefficient < Number(0);
    for (std::size_t k = 0; k < result_.sides.size(); ++k) {
      const auto factor = multiple_of(scaled.rest, k);
      if (!factor) continue;
      const Expression side = factor->is_one() ? result_.sides[k] : sign_of(*factor) * result_.sides[k];
      return opposite ? -side : side;
    }
    result_.short_forms.push_back(scaled.rest);
    const bool is_short = argument.computed == argument.short_form;
    result_.arguments.push_back(is_short ? scaled.rest : opposite ? -argument.computed : argument.computed);
    result_.sides.push_back(graph_.symbol("side " + std::to_string(result_.sides.size() + 1)));
    return opposite ? -result_.sides.back() : result_.sides.back();
  }

  /// c without variables and t in u = c u_k, where that has a number for a slope: two dry frictions on one
  /// belt are one.
  [[nodiscard]] std::optional<Expression> multiple_of(const Expression& u, std::size_t k) const {
    const Expression& known = result_.short_forms[k];
    if (u == known) return graph_.number(1);
    if (result_.sides.size() > most_arguments_compared) return std::nullopt;
    for (const Expression& variable : variables_) {
      const Expression slope = simplify(differentiate(known, variable));
      if (slope.is_zero()) continue;
      if (slope.number() == nullptr) return std::nullopt;  // a parameter may be 0, and the other one not
      const Expression factor = simplify(differentiate(u, variable) / slope);
      const bool varies = depends_on(factor, variables_) || depends_on(factor, graph_.symbol("t"));
      const bool is_multiple = !varies && !factor.is_zero() && simplify(u - factor * known).is_zero();
      return is_multiple ? std::optional(factor) : std::nullopt;
    }
    return std::nullopt;
  }

  [[nodiscard]] Expression sign_of(const Expression& factor) const {
    const Number* number = factor.number();
    if (number == nullptr) return graph_.call(Function::sign, factor);
    return graph_.number(*number < Number(0) ? -1 : 1);
  }

  /// s^2 = 1.
  Expression without_even_powers(const Expression& e) {
    std::vector<Replacement> powers;
    const NodeId root[]{e.id()};
    for (const NodeId id : reachable(graph_, root)) {
      const auto* power = std::get_if<Power>(&graph_.node(id));
      if (power == nullptr || !power->exponent.is_integer()) continue;
      const Expression base(graph_, power->base);
      if (std::ranges::find(result_.sides, base) == result_.sides.end()) continue;
      const bool even = (power->exponent * Number::ratio(1, 2)).is_integer();
      powers.emplace_back(Expression(graph_, id), even ? graph_.number(1) : base);
    }
    return powers.empty() ? e : shortened(substitute(e, powers));
  }

  Graph& graph_;
  std::span<const Expression> variables_;
  Unfolded result_;
};

}  // namespace

Unfolded unfolded(std::span<const Expression> expressions, std::span<const Expression> variables) {
  if (expressions.empty()) return {};
  return Unfolding(expressions[0].graph(), variables).run(expressions);
}

}  // namespace qdot
