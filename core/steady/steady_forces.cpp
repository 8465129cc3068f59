#include "core/steady/steady_forces.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/compile/tape_evaluator.hpp"
#include "core/expr/full_turn.hpp"
#include "core/expr/kept_terms.hpp"
#include "core/expr/simplify.hpp"
#include "core/steady/numerator.hpp"

namespace qdot {
namespace {

bool has_velocities(const Model& model, const Reduction& reduction) {
  if (reduction.without_growth) return true;
  const std::vector<Expression>& rate = model.lagrangian.symbols.coordinates.rate;
  return std::any_of(reduction.kept.begin(), reduction.kept.end(),
                     [&](std::size_t i) { return depends_on(model.lagrangian.generalized_forces[i], rate); });
}

/// Beside others an equation that is divided by its vanishing mass belongs to no energy, as b'' = a - b
/// beside a'' = -a.
bool has_limits(const Reduction& reduction) { return reduction.kept.size() > 1 && !reduction.limits.empty(); }

bool is_gradient(const std::vector<Expression>& stiffness, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!simplify(stiffness[i * n + j] - stiffness[j * n + i]).is_zero()) return false;
    }
  }
  return true;
}

}  // namespace

bool is_gradient(const Model& model, const Statics& statics) {
  if (has_limits(statics.reduction)) return false;
  const auto& forces = model.lagrangian.generalized_forces;
  if (std::ranges::all_of(forces, [](const Expression& force) { return force.is_zero(); })) return true;
  Graph graph(*statics.reduction.graph);
  const std::size_t n = statics.rest.size();
  std::vector<Expression> stiffness;
  for (const Expression& force : statics.rest) {
    for (const Expression& x : statics.reduction.x)
      stiffness.push_back(differentiate(graph.adopt(force), graph.adopt(x)));
  }
  return is_gradient(stiffness, n);
}

bool has_potential(const Model& model, const Statics& statics) {
  return !has_velocities(model, statics.reduction) && is_gradient(model, statics);
}

std::vector<Expression> rates_at_rest(const Reduction& reduction, Graph& graph) {
  std::vector<Replacement> rest;
  for (const Expression& symbol : reduction.x_dot) rest.emplace_back(graph.adopt(symbol), graph.number(0));
  std::vector<Expression> rates;
  for (const Expression& rate : reduction.ignored_rates) rates.push_back(substitute(graph.adopt(rate), rest));
  return rates;
}

SteadyForces compiled_forces(const Model& model, const Reduction& reduction, const RestEquations& equations) {
  SteadyForces result;
  Graph& graph = *equations.graph;
  result.graph = equations.graph;
  result.rest = equations.rest;
  std::vector<Expression> x, stiffness, nonzero;
  for (const Expression& symbol : reduction.x) x.push_back(graph.adopt(symbol));
  for (std::size_t i = 0; i < result.rest.size(); ++i) {
    result.has_poles = result.has_poles || !(numerator_of(result.rest[i], x) == result.rest[i]);
    if (!result.rest[i].is_zero()) result.equations.push_back(i);
    for (const Expression& xj : x) stiffness.push_back(shortened_derivative(equations.written[i], xj));
  }
  const auto any = [&](const auto& holds) { return std::ranges::any_of(result.rest, holds); };
  for (std::size_t j = 0; j < x.size(); ++j) {
    if (!model.scene.coordinates[reduction.kept[j]].domain.contains(0)) nonzero.push_back(x[j]);
    const bool matters = any([&](const Expression& g) { return depends_on(g, x[j]); });
    (matters ? result.unknowns : result.free).push_back(j);
    const bool angle = model.scene.coordinates[reduction.kept[j]].unit == "rad" || model.scene.without_units;
    result.turns.push_back(angle && !any([&](const Expression& g) { return !has_full_turn(g, x[j]); }));
  }
  result.symmetric =
      result.rest.size() == x.size() && !has_limits(reduction) && is_gradient(stiffness, x.size());
  result.forces = compiled_at_rest(reduction, graph, equations.written);
  result.stiffness = compiled_at_rest(reduction, graph, stiffness);
  result.smooth = derive_smooth_forces(reduction, graph, equations.written, nonzero);
  result.determinants = result.ignored_rates = compiled_at_rest(reduction, graph, {});
  return result;
}

namespace {

std::vector<ConeForms> forms_of_cones(const Reduction& reduction, Graph& graph, const SteadyForces& forces) {
  if (forces.smooth.kinks() > 0) return {};
  std::vector<Expression> constants, x, unknowns, equations;
  for (const Expression& c : reduction.constants) constants.push_back(graph.adopt(c));
  for (const Expression& symbol : reduction.x) x.push_back(graph.adopt(symbol));
  for (const std::size_t j : forces.unknowns) unknowns.push_back(x[j]);
  for (const std::size_t i : forces.equations) equations.push_back(forces.rest[i]);
  return derive_cones(constants, x, unknowns, equations);
}

}  // namespace

SteadyForces derive_steady_forces(const Model& model, const Statics& statics,
                                  std::span<const Expression> absent) {
  const Reduction& reduction = statics.reduction;
  RestEquations equations{std::make_shared<Graph>(*reduction.graph), {}, {}};
  Graph& graph = *equations.graph;
  std::vector<Replacement> zeros;
  for (const Expression& symbol : absent) zeros.emplace_back(graph.adopt(symbol), graph.number(0));
  const auto without_absent = [&](const Expression& e) {
    return zeros.empty() ? graph.adopt(e) : shortened(substitute(graph.adopt(e), zeros));
  };
  for (std::size_t i = 0; i < statics.rest.size(); ++i) {
    equations.rest.push_back(without_absent(statics.rest[i]));
    equations.written.push_back(equations.rest[i].is_zero() ? equations.rest[i]
                                                            : without_absent(reduction.forces_at_rest[i]));
  }
  SteadyForces result = compiled_forces(model, reduction, equations);
  result.has_potential = result.symmetric && !has_velocities(model, reduction);
  std::vector<Expression> rates;
  for (const Expression& rate : rates_at_rest(reduction, graph)) rates.push_back(without_absent(rate));
  result.ignored_rates = compiled_at_rest(reduction, graph, rates);
  result.cones = forms_of_cones(reduction, graph, result);
  return result;
}

/// In balls, which have the exact zero where the terms of decimals cancel.
std::vector<Interval> momenta_at(const Dynamics& dynamics, const Statics& statics, const Reals& parameters,
                                 const Reals& y) {
  std::vector<Ball> momenta(statics.reduction.ignored.size());
  std::vector<Interval> result;
  if (momenta.empty()) return result;
  const auto function = dynamics.columns(momentum_columns(dynamics.model(), statics.reduction.ignored));
  TapeEvaluator<Ball>(*function, parameters.as<Ball>())(y.as<Ball>(), momenta);
  for (const Ball& p : momenta) {
    result.push_back(p.interval());
    if (!result.back().is_finite())
      throw Error(ErrorCode::invalid_state, "A momentum has no finite value in this state.");
  }
  return result;
}

VanishingMomenta vanishing_momenta(const Statics& statics, std::span<const Interval> momenta) {
  VanishingMomenta result;
  const std::vector<Expression>& constants = statics.reduction.constants;
  for (std::size_t k = 0; k < momenta.size(); ++k) {
    result.vanishing.push_back(momenta[k].lower == 0 && momenta[k].upper == 0);
    if (result.vanishing.back()) result.absent.push_back(constants[constants.size() - momenta.size() + k]);
    result.key += result.vanishing.back() ? " 0" : " p";
  }
  return result;
}

void refuse_dry_friction(const Dynamics& dynamics, const Reals& parameters,
                         const std::vector<bool>& vanishing) {
  struct Friction {
    bool dry{};
  };
  std::string key = "dry friction";
  for (const bool is_zero : vanishing) key += is_zero ? " 0" : " p";
  const auto friction = dynamics.derived<Friction>(key, parameters, [&](const Statics& statics) {
    return Friction{has_dry_friction(statics.reduction, vanishing)};
  });
  if (!friction->dry) return;
  throw Error(ErrorCode::not_applicable,
              "Dry friction (the sign of a velocity) takes any value between its two sides at rest, so the "
              "system stays wherever the other forces are weaker: whole intervals of positions are in "
              "equilibrium, and no list of points names them.");
}

SteadyProblem steady_problem(const Dynamics& dynamics, const Reals& parameters, const Reals& y) {
  SteadyProblem problem{dynamics.statics(parameters), nullptr, parameters, {}};
  problem.constants = parameters.as<Interval>();
  const std::vector<Interval> momenta = momenta_at(dynamics, *problem.statics, parameters, y);
  problem.constants.insert(problem.constants.end(), momenta.begin(), momenta.end());
  const VanishingMomenta those = vanishing_momenta(*problem.statics, momenta);
  refuse_dry_friction(dynamics, parameters, those.vanishing);
  problem.forces = dynamics.derived<SteadyForces>(
      "steady forces" + those.key, parameters,
      [&](const Statics& statics) { return derive_steady_forces(dynamics.model(), statics, those.absent); });
  return problem;
}

}  // namespace qdot
