#include "core/steady/kinks.hpp"

#include <algorithm>

#include "core/compile/tape_builder.hpp"
#include "core/expr/kept_terms.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/simplify.hpp"
#include "core/steady/combined_forces.hpp"
#include "core/steady/hyperbolic_tails.hpp"
#include "core/steady/numerator.hpp"
#include "core/steady/reduced_forces.hpp"

namespace qdot {
namespace {

bool never_vanishes(const Expression& base, std::span<const Expression> nonzero) {
  const auto* call = std::get_if<Call>(&base.node());
  return (call != nullptr && (call->function == Function::exp || call->function == Function::cosh)) ||
         std::ranges::find(nonzero, base) != nonzero.end();
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
    return raised.base == pieces.short_forms[k] && Number(0) < raised.exponent;
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

SmoothForces derive_smooth_forces(const Reduction& reduction, Graph& graph, std::span<const Expression> rest,
                                  std::span<const Expression> nonzero) {
  std::vector<Expression> constants, x;
  for (const Expression& c : reduction.constants) constants.push_back(graph.adopt(c));
  for (const Expression& symbol : reduction.x) x.push_back(graph.adopt(symbol));
  Unfolded pieces = unfolded(rest, x);
  std::vector<Expression> forces;
  std::ranges::copy_if(pieces.smooth, std::back_inserter(forces),
                       [](const Expression& g) { return !g.is_zero(); });
  for (Expression& g : pieces.smooth) g = without_nonzero_factors(with_hyperbolic_tails(g), nonzero);
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
      for (const Expression& v : variables) result.push_back(shortened_derivative(f, v));
    }
    return result;
  };
  std::vector<Expression> numerators;
  for (const Expression& g : pieces.smooth) numerators.push_back(numerator_of(g, variables));
  std::vector<Expression> combined = combinations(forces);
  std::ranges::copy(reduced_equations(forces, variables), std::back_inserter(combined));
  std::vector<bool> jumps;
  for (std::size_t k = 0; k < pieces.sides.size(); ++k) jumps.push_back(jumps_at(pieces, k));
  return {jumps,
          compiled(pieces.smooth),
          compiled(derivatives(pieces.smooth)),
          compiled(numerators),
          compiled(combined),
          compiled(pieces.arguments),
          compiled(derivatives(pieces.arguments))};
}

SmoothForces derive_smooth_forces(const Statics& statics) {
  Graph graph(*statics.reduction.graph);
  std::vector<Expression> rest;
  for (const Expression& g : statics.rest) rest.push_back(graph.adopt(g));
  return derive_smooth_forces(statics.reduction, graph, rest, {});
}

bool has_dry_friction(const Reduction& reduction, const std::vector<bool>& vanishing) {
  Graph graph(*reduction.graph);
  std::vector<Replacement> rest;
  for (const auto* symbols : {&reduction.x_dot, &reduction.x_ddot}) {
    for (const Expression& symbol : *symbols) rest.emplace_back(graph.adopt(symbol), graph.number(0));
  }
  const auto momenta = std::span(reduction.constants).last(reduction.ignored.size());
  for (std::size_t c = 0; c < vanishing.size(); ++c) {
    if (vanishing[c]) rest.emplace_back(graph.adopt(momenta[c]), graph.number(0));
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
