#include "core/expr/unfold.hpp"

#include <algorithm>
#include <optional>

#include "core/base/error.hpp"
#include "core/expr/kept_terms.hpp"
#include "core/expr/polynomial_gcd.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_arguments_compared = 8;  ///< arguments

bool is_even(const Number& n) { return (n / Number(2)).is_integer(); }

bool divides(const Polynomial& terms) {
  return std::ranges::any_of(terms, [](const auto& term) {
    return std::ranges::any_of(term.first, [](const Atom& atom) { return atom.p < 0; });
  });
}

/// Of a sum under a root, where one of the variables is in them.
std::optional<SquareFactors> squares_in(const Expression& base, std::span<const Expression> variables) {
  try {
    SquareFactors parts = square_factors(multiplied_out(base));
    const bool varies = depends_on(to_expression(base.graph(), parts.outside), variables);
    return varies && !divides(parts.outside) ? std::optional(std::move(parts)) : std::nullopt;
  } catch (const Error&) {  // too large
    return std::nullopt;
  }
}

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
  /// In its short form, by which it is known again, and as it is computed, which keeps its digits.
  struct Argument {
    Expression short_form, computed;
  };

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
    const auto size =
        is_even_power(power.base) ? size_of(power.base, power.exponent) : size_of_squares(power);
    if (size) result_.replacements.emplace_back(Expression(graph_, id), *size);
  }

  [[nodiscard]] bool is_even_power(NodeId id) const {
    const auto* power = std::get_if<Power>(&graph_.node(id));
    return power != nullptr && is_even(power->exponent);
  }

  /// |u|^(p q) for the even power u^p.
  [[nodiscard]] Expression size_of(NodeId even_power, const Number& q) {
    const Power inner = std::get<Power>(graph_.node(even_power));
    return size_of(argument_of({graph_, inner.base}), inner.exponent * q);
  }

  [[nodiscard]] Expression size_of(const Argument& u, const Number& exponent) {
    const Expression size =
        exponent.is_integer() ? side_of(u) * u.computed : graph_.call(Function::abs, u.computed);
    return pow(size, exponent);
  }

  /// (a u^2)^q is a^q |u|^(2 q), also where the square is written out: it has no value for a < 0.
  [[nodiscard]] std::optional<Expression> size_of_squares(const Power& power) {
    if (const auto sizes = size_of_factors(power)) return sizes;
    const std::optional<SquareFactors> parts = squares_in({graph_, power.base}, variables_);
    if (!parts) return std::nullopt;
    const Expression u = to_expression(graph_, parts->outside), a = to_expression(graph_, parts->inside);
    return pow(smooth(a), power.exponent) * size_of(argument_of(u), Number(2) * power.exponent);
  }

  /// As they are written, which keeps digits, where all that varies are even powers.
  [[nodiscard]] std::optional<Expression> size_of_factors(const Power& power) {
    const auto* found = std::get_if<Product>(&graph_.node(power.base));
    if (found == nullptr) return std::nullopt;
    const Product product = *found;
    Expression constant = graph_.number(product.coefficient), sizes = graph_.number(1);
    for (const NodeId factor : product.factors) {
      const bool varies = depends_on(Expression(graph_, factor), variables_);
      if (varies && !is_even_power(factor)) return std::nullopt;
      if (!varies) constant = constant * Expression(graph_, factor);
    }
    for (const NodeId factor : product.factors) {
      if (depends_on(Expression(graph_, factor), variables_)) sizes = sizes * size_of(factor, power.exponent);
    }
    return pow(constant, power.exponent) * sizes;
  }

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
      const auto shared = shared_with(scaled.rest, k);
      if (!shared) continue;
      if (shared->known != graph_.number(1)) measure_by(k, *shared);
      const Expression side = sign_of(shared->one) * result_.sides[k];
      return opposite ? -side : side;
    }
    result_.short_forms.push_back(scaled.rest);
    const bool is_short = argument.computed == argument.short_form;
    result_.arguments.push_back(is_short ? scaled.rest : opposite ? -argument.computed : argument.computed);
    result_.sides.push_back(new_side());
    return opposite ? -result_.sides.back() : result_.sides.back();
  }

  [[nodiscard]] Expression new_side() { return graph_.symbol("side " + std::to_string(++numbered_)); }

  /// u = one v and u_k = known v, with factors that are constant.
  struct Shared {
    Expression v, one, known;
  };

  /// Two dry frictions on one belt are one. Neither factor divides by what may be zero where the other is
  /// not.
  [[nodiscard]] std::optional<Shared> shared_with(const Expression& u, std::size_t k) const {
    const Expression& known = result_.short_forms[k];
    if (u == known) return Shared{known, graph_.number(1), graph_.number(1)};
    if (result_.sides.size() > most_arguments_compared) return std::nullopt;
    const Parts a = parts_of(u), b = parts_of(known);
    try {
      const Polynomial v = greatest_common_divisor(a.varying, b.varying);
      const auto one = exact_quotient(a.varying, v), other = exact_quotient(b.varying, v);
      if (!one || !other) return std::nullopt;
      Shared shared{to_expression(graph_, v), to_expression(graph_, *one) * a.constant,
                    to_expression(graph_, *other) * b.constant};
      if (varies(shared.one) || varies(shared.known)) return std::nullopt;
      if (const Expression ratio = simplify(shared.one / shared.known); !divides(multiplied_out(ratio)))
        return Shared{known, ratio, graph_.number(1)};
      return result_.arguments[k] == known ? std::optional(shared) : std::nullopt;
    } catch (const Error&) {  // too large
      return std::nullopt;
    }
  }

  [[nodiscard]] bool varies(const Expression& e) const {
    return depends_on(e, variables_) || depends_on(e, graph_.symbol("t"));
  }

  /// A polynomial, and a constant that all its terms have for a factor: x_dot - a/R is R x_dot - a and 1/R.
  struct Parts {
    Polynomial varying;
    Expression constant;
  };
  [[nodiscard]] Parts parts_of(const Expression& u) const {
    Polynomial terms = multiplied_out(u);
    Monomial constant;
    for (const Atom& atom : common_monomial(terms)) {
      if (!varies({graph_, atom.base})) constant.push_back(atom);
    }
    terms = scaled(terms, inverse(constant), Number(1));
    Monomial divisors;
    for (const auto& [monomial, coefficient] : terms) {
      for (const Atom& atom : monomial) {
        const int missing = -exponent_of(divisors, atom.base) - atom.p;
        if (atom.q == 1 && missing > 0 && !varies({graph_, atom.base}))
          divisors = times(divisors, atom.base, missing);
      }
    }
    return {scaled(terms, divisors, Number(1)), to_expression(graph_, constant * inverse(divisors))};
  }

  /// v takes the place of u_k = f v.
  void measure_by(std::size_t k, const Shared& shared) {
    const Expression side = new_side();
    const Replacement replaced{result_.sides[k], sign_of(shared.known) * side};
    for (auto& [kink, smooth] : result_.replacements) smooth = substitute(smooth, {&replaced, 1});
    for (Expression& u : result_.arguments) u = substitute(u, {&replaced, 1});
    for (Expression& u : result_.short_forms) u = substitute(u, {&replaced, 1});
    result_.sides[k] = side;
    result_.arguments[k] = result_.short_forms[k] = shared.v;
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
      powers.emplace_back(Expression(graph_, id), is_even(power->exponent) ? graph_.number(1) : base);
    }
    return powers.empty() ? e : shortened(substitute(e, powers));
  }

  Graph& graph_;
  std::span<const Expression> variables_;
  Unfolded result_;
  int numbered_{};
};

}  // namespace

Expression with_squares_under_roots(const Expression& e, std::span<const Expression> variables) {
  Graph& graph = e.graph();
  std::vector<Replacement> found;
  const NodeId root[]{e.id()};
  for (const NodeId id : reachable(graph, root)) {
    const auto* node = std::get_if<Power>(&graph.node(id));
    if (node == nullptr || node->exponent.is_integer()) continue;
    const Number q = node->exponent;
    const Expression base(graph, node->base);
    if (const auto* inner = std::get_if<Power>(&base.node()); inner != nullptr && is_even(inner->exponent)) {
      const Number n = inner->exponent;
      const Expression u(graph, inner->base);
      if (depends_on(u, variables))
        found.emplace_back(Expression(graph, id), pow(graph.call(Function::abs, u), n * q));
      continue;
    }
    const std::optional<SquareFactors> parts = squares_in(base, variables);
    if (!parts) continue;
    const Expression u = to_expression(graph, parts->outside), a = to_expression(graph, parts->inside);
    found.emplace_back(Expression(graph, id), pow(a, q) * pow(graph.call(Function::abs, u), Number(2) * q));
  }
  return found.empty() ? e : substitute(e, found);
}

Unfolded unfolded(std::span<const Expression> expressions, std::span<const Expression> variables) {
  if (expressions.empty()) return {};
  return Unfolding(expressions[0].graph(), variables).run(expressions);
}

}  // namespace qdot
