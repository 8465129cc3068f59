#include "core/steady/kinks.hpp"

#include <algorithm>

#include "core/compile/tape_builder.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/simplify.hpp"
#include "core/steady/numerator.hpp"

namespace qdot {
namespace {

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
    return replacements_.empty() ? e : substitute(e, replacements_);
  }

  void unfold(NodeId id) {
    const Call call = std::get<Call>(graph_.node(id));
    const Expression argument = simplify(smooth({graph_, call.argument}));
    const Expression side = side_of(argument);
    replacements_.emplace_back(Expression(graph_, id),
                               call.function == Function::sign ? side : side * argument);
  }

  /// |u|^p has no kink for p > 1, and is real only of |u| itself; (u^2)^(p/2) is |u|^p.
  void unfold(NodeId id, Power power) {
    if (power.exponent.is_integer()) return;
    const auto* call = std::get_if<Call>(&graph_.node(power.base));
    if (call != nullptr && call->function == Function::abs) {
      const Expression size = graph_.call(Function::abs, smooth({graph_, call->argument}));
      replacements_.emplace_back(Expression(graph_, id), pow(size, power.exponent));
    }
    const auto* inner = std::get_if<Power>(&graph_.node(power.base));
    if (inner == nullptr || !(inner->exponent * Number::ratio(1, 2)).is_integer()) return;
    const Expression base = simplify(smooth({graph_, inner->base}));
    const Number exponent = inner->exponent * power.exponent;
    const Expression size = exponent.is_integer() ? side_of(base) * base : graph_.call(Function::abs, base);
    replacements_.emplace_back(Expression(graph_, id), pow(size, exponent));
  }

  /// The same for every multiple of one argument.
  Expression side_of(const Expression& argument) {
    const Scaled scaled = split_coefficient(argument);
    const bool opposite = scaled.coefficient < Number(0);
    const auto known = std::ranges::find(result_.arguments, scaled.rest);
    const auto k = static_cast<std::size_t>(known - result_.arguments.begin());
    if (known == result_.arguments.end()) {
      result_.arguments.push_back(scaled.rest);
      result_.sides.push_back(graph_.symbol("side " + std::to_string(k + 1)));
    }
    return opposite ? -result_.sides[k] : result_.sides[k];
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
    return powers.empty() ? e : simplify(substitute(e, powers));
  }

  Graph& graph_;
  std::span<const Expression> variables_;
  std::vector<Replacement> replacements_;
  Unfolded result_;
};

bool never_vanishes(const Expression& base, std::span<const Expression> nonzero) {
  const auto* call = std::get_if<Call>(&base.node());
  return (call != nullptr && (call->function == Function::exp || call->function == Function::cosh)) ||
         std::ranges::find(nonzero, base) != nonzero.end();
}

bool has_tanh(const Expression& e) {
  const NodeId root[]{e.id()};
  return std::ranges::any_of(reachable(e.graph(), root), [&](NodeId id) {
    const auto* call = std::get_if<Call>(&e.graph().node(id));
    return call != nullptr && call->function == Function::tanh;
  });
}

/// tanh^2 = 1 - 1/cosh^2, so that 1 - tanh^2 keeps its sign where tanh rounds to 1.
Expression without_tanh_squares(const Expression& given) {
  Graph& graph = given.graph();
  if (!has_tanh(given)) return given;
  const Expression e = expand(given);
  std::vector<Replacement> squares;
  const NodeId root[]{e.id()};
  for (const NodeId id : reachable(graph, root)) {
    const auto* power = std::get_if<Power>(&graph.node(id));
    const auto* call = power == nullptr ? nullptr : std::get_if<Call>(&graph.node(power->base));
    if (call == nullptr || call->function != Function::tanh || !(power->exponent == Number(2))) continue;
    const Expression u(graph, call->argument);
    squares.emplace_back(Expression(graph, id),
                         graph.number(1) - pow(graph.call(Function::cosh, u), Number(-2)));
  }
  return squares.empty() ? given : simplify(substitute(e, squares));
}

/// e with the zeros that it has: without what all its terms share and what has no zeros.
Expression without_nonzero_factors(const Expression& e, std::span<const Expression> nonzero) {
  Graph& graph = e.graph();
  const Polynomial terms = multiplied_out(e);
  if (terms.empty()) return e;
  Monomial inverse;
  for (const Atom& atom : terms.begin()->first) {
    if (!never_vanishes(Expression(graph, atom.base), nonzero)) continue;
    std::optional<Atom> least;
    for (const auto& [monomial, coefficient] : terms) {
      const auto here = std::ranges::find(monomial, atom.base, &Atom::base);
      const bool shared = here != monomial.end() && (here->p > 0) == (atom.p > 0);
      if (!shared) {
        least.reset();
        break;
      }
      if (!least || std::abs(here->p) * least->q < std::abs(least->p) * here->q) least = *here;
    }
    if (least) inverse = times(inverse, atom.base, -least->p, least->q);
  }
  if (inverse.empty()) return e;
  return simplify(to_expression(graph, scaled(terms, inverse, Number(1))));
}

/// Whether some function depends on the side at the kink itself, where the argument is 0.
bool jumps_at(const Unfolded& pieces, std::size_t k) {
  const auto is_argument = [&](const Expression& factor) {
    const Raised raised = split_power(factor);
    return raised.base == pieces.arguments[k] && Number(0) < raised.exponent;
  };
  return std::ranges::any_of(pieces.smooth, [&](const Expression& g) {
    const Expression jump = simplify(differentiate(g, pieces.sides[k]));
    const auto* product = std::get_if<Product>(&jump.node());
    if (product == nullptr) return !jump.is_zero() && !is_argument(jump);
    return std::ranges::none_of(product->factors,
                                [&](NodeId id) { return is_argument(Expression(jump.graph(), id)); });
  });
}

}  // namespace

Unfolded unfolded(std::span<const Expression> expressions, std::span<const Expression> variables) {
  if (expressions.empty()) return {};
  return Unfolding(expressions[0].graph(), variables).run(expressions);
}

SmoothForces derive_smooth_forces(const Reduction& reduction, Graph& graph, std::span<const Expression> rest,
                                  std::span<const Expression> nonzero) {
  std::vector<Expression> constants, x;
  for (const Expression& c : reduction.constants) constants.push_back(graph.adopt(c));
  for (const Expression& symbol : reduction.x) x.push_back(graph.adopt(symbol));
  Unfolded pieces = unfolded(rest, x);
  for (Expression& g : pieces.smooth) g = without_nonzero_factors(without_tanh_squares(g), nonzero);
  std::vector<Expression> variables = x;
  variables.insert(variables.end(), pieces.sides.begin(), pieces.sides.end());
  const auto compiled = [&](const std::vector<Expression>& expressions) {
    TapeBuilder tape(graph, constants, graph.symbol("t"), variables);
    for (const Expression& e : expressions) tape.output(e);
    return tape.finish();
  };
  const auto derivatives = [&](const std::vector<Expression>& functions) {
    std::vector<Expression> result;
    for (const Expression& f : functions) {
      for (const Expression& v : variables) result.push_back(simplify(differentiate(f, v)));
    }
    return result;
  };
  std::vector<Expression> numerators;
  for (const Expression& g : pieces.smooth) numerators.push_back(numerator_of(g, variables));
  std::vector<bool> jumps;
  for (std::size_t k = 0; k < pieces.sides.size(); ++k) jumps.push_back(jumps_at(pieces, k));
  return {jumps,
          compiled(pieces.smooth),
          compiled(derivatives(pieces.smooth)),
          compiled(numerators),
          compiled(pieces.arguments),
          compiled(derivatives(pieces.arguments))};
}

SmoothForces derive_smooth_forces(const Statics& statics) {
  Graph graph(*statics.reduction.graph);
  std::vector<Expression> rest;
  for (const Expression& g : statics.rest) rest.push_back(graph.adopt(g));
  return derive_smooth_forces(statics.reduction, graph, rest, {});
}

bool has_dry_friction(const Reduction& reduction) {
  Graph graph(*reduction.graph);
  std::vector<Replacement> rest;
  for (const auto* symbols : {&reduction.x_dot, &reduction.x_ddot}) {
    for (const Expression& symbol : *symbols) rest.emplace_back(graph.adopt(symbol), graph.number(0));
  }
  std::vector<Expression> velocities, equations;
  for (const Expression& symbol : reduction.x_dot) velocities.push_back(graph.adopt(symbol));
  for (const Expression& e : reduction.equations) equations.push_back(graph.adopt(e));
  const Unfolded pieces = unfolded(equations, velocities);
  std::vector<Expression> sides;
  for (std::size_t k = 0; k < pieces.sides.size(); ++k) {
    if (simplify(substitute(pieces.arguments[k], rest)).is_zero()) sides.push_back(pieces.sides[k]);
  }
  return !sides.empty() && std::ranges::any_of(pieces.smooth, [&](const Expression& e) {
    return depends_on(simplify(substitute(e, rest)), sides);
  });
}

}  // namespace qdot
