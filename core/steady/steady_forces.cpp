#include "core/steady/steady_forces.hpp"

#include <algorithm>
#include <map>

#include "core/base/error.hpp"
#include "core/compile/tape_evaluator.hpp"
#include "core/expr/full_turn.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

struct Fraction {
  int p{};
  int q{1};
};

bool less(const Fraction& a, const Fraction& b) { return a.p * b.q < b.p * a.q; }

/// The most negative exponent of each base with one of the variables in it.
std::map<NodeId, Fraction> poles_of(Graph& graph, const Polynomial& polynomial,
                                    std::span<const Expression> variables) {
  std::map<NodeId, Fraction> poles;
  for (const auto& [monomial, coefficient] : polynomial) {
    for (const Atom& atom : monomial) {
      if (atom.p > 0 || !depends_on(Expression(graph, atom.base), variables)) continue;
      Fraction& least = poles[atom.base];
      if (less({atom.p, atom.q}, least)) least = {atom.p, atom.q};
    }
  }
  return poles;
}

bool has_negative_power(const Expression& e, std::span<const Expression> variables) {
  const NodeId root = e.id();
  for (const NodeId id : reachable(e.graph(), {&root, 1})) {
    const auto* power = std::get_if<Power>(&e.graph().node(id));
    if (power != nullptr && power->exponent < Number(0) &&
        depends_on(Expression(e.graph(), power->base), variables)) {
      return true;
    }
  }
  return false;
}

bool has_velocities(const Model& model, const Reduction& reduction) {
  const std::vector<Expression>& rate = model.lagrangian.symbols.coordinates.rate;
  return std::any_of(reduction.kept.begin(), reduction.kept.end(),
                     [&](std::size_t i) { return depends_on(model.lagrangian.generalized_forces[i], rate); });
}

bool is_gradient(const std::vector<Expression>& stiffness, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!simplify(stiffness[i * n + j] - stiffness[j * n + i]).is_zero()) return false;
    }
  }
  return true;
}

}  // namespace

Expression numerator_of(const Expression& e, std::span<const Expression> variables) {
  if (!has_negative_power(e, variables)) return e;
  Graph& graph = e.graph();
  const Polynomial polynomial = multiplied_out(e);
  Monomial common;
  for (const auto& [base, exponent] : poles_of(graph, polynomial, variables)) {
    common = times(common, base, -exponent.p, exponent.q);
  }
  if (common.empty()) return e;
  return simplify(to_expression(graph, scaled(polynomial, common, Number(1))));
}

std::vector<Expression> rates_at_rest(const Reduction& reduction, Graph& graph) {
  std::vector<Replacement> rest;
  for (const Expression& symbol : reduction.x_dot) rest.emplace_back(graph.adopt(symbol), graph.number(0));
  std::vector<Expression> rates;
  for (const Expression& rate : reduction.ignored_rates) rates.push_back(substitute(graph.adopt(rate), rest));
  return rates;
}

SteadyForces derive_steady_forces(const Model& model, const Statics& statics,
                                  std::span<const Expression> absent) {
  const Reduction& reduction = statics.reduction;
  SteadyForces result;
  const auto own = std::make_shared<Graph>(*reduction.graph);
  Graph& graph = *own;
  result.graph = own;
  std::vector<Replacement> zeros;
  for (const Expression& symbol : absent) zeros.emplace_back(graph.adopt(symbol), graph.number(0));
  const auto without_absent = [&](const Expression& e) {
    return zeros.empty() ? graph.adopt(e) : simplify(substitute(graph.adopt(e), zeros));
  };
  std::vector<Expression> x, numerators, stiffness, rates;
  for (const Expression& symbol : reduction.x) x.push_back(graph.adopt(symbol));
  for (std::size_t i = 0; i < statics.rest.size(); ++i) {
    result.rest.push_back(without_absent(statics.rest[i]));
    numerators.push_back(numerator_of(result.rest[i], x));
    result.has_poles = result.has_poles || !(numerators[i] == result.rest[i]);
    if (!result.rest[i].is_zero()) result.equations.push_back(i);
    for (const Expression& xj : x) stiffness.push_back(simplify(differentiate(result.rest[i], xj)));
  }
  for (std::size_t j = 0; j < x.size(); ++j) {
    const auto any = [&](const auto& holds) {
      return std::any_of(result.rest.begin(), result.rest.end(), holds);
    };
    const bool matters = any([&](const Expression& g) { return depends_on(g, x[j]); });
    (matters ? result.unknowns : result.free).push_back(j);
    const bool angle = model.scene.coordinates[reduction.kept[j]].unit == "rad";
    result.turns.push_back(angle && !any([&](const Expression& g) { return !has_full_turn(g, x[j]); }));
  }
  for (const Expression& rate : rates_at_rest(reduction, graph)) rates.push_back(without_absent(rate));
  result.has_potential = !has_velocities(model, reduction) && is_gradient(stiffness, x.size());
  result.forces = compiled_at_rest(reduction, graph, result.rest);
  result.stiffness = compiled_at_rest(reduction, graph, stiffness);
  result.ignored_rates = compiled_at_rest(reduction, graph, rates);
  result.numerators = compiled_at_rest(reduction, graph, numerators);
  return result;
}

namespace {

/// The momenta of the ignored coordinates, enclosed:
/// beside the parameters they are what the forces know of y.
std::vector<Interval> momenta_at(const Dynamics& dynamics, const Statics& statics,
                                 std::span<const double> parameters, std::span<const double> y) {
  std::vector<Interval> momenta(statics.reduction.ignored.size());
  if (momenta.empty()) return momenta;
  const auto function = dynamics.columns(momentum_columns(dynamics.model(), statics.reduction.ignored));
  const std::vector<Interval> bound(parameters.begin(), parameters.end());
  const std::vector<Interval> state(y.begin(), y.end());
  TapeEvaluator<Interval>(*function, bound)(state, momenta);
  for (const Interval& p : momenta) {
    if (!p.is_finite())
      throw Error(ErrorCode::invalid_state, "A momentum has no finite value in this state.");
  }
  return momenta;
}

}  // namespace

SteadyProblem steady_problem(const Dynamics& dynamics, std::span<const double> parameters,
                             std::span<const double> y) {
  SteadyProblem problem{dynamics.statics(parameters), nullptr, {parameters.begin(), parameters.end()}, {}};
  problem.constants.assign(parameters.begin(), parameters.end());
  std::string key = "steady forces";
  std::vector<Expression> absent;
  for (const Interval& p : momenta_at(dynamics, *problem.statics, parameters, y)) {
    const bool vanishes = p.lower == 0 && p.upper == 0;
    if (vanishes) absent.push_back(problem.statics->reduction.constants[problem.constants.size()]);
    key += vanishes ? " 0" : " p";
    problem.constants.push_back(p);
  }
  problem.forces = dynamics.derived<SteadyForces>(key, parameters, [&](const Statics& statics) {
    return derive_steady_forces(dynamics.model(), statics, absent);
  });
  return problem;
}

}  // namespace qdot
