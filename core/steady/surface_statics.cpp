#include "core/steady/surface_statics.hpp"

#include "core/base/error.hpp"
#include "core/compile/tape_evaluator.hpp"
#include "core/mechanics/friction.hpp"

namespace qdot {
namespace {

/// The model with L + sum of lambda phi, in which the multipliers are coordinates, too. Constraints in the
/// velocities remain forces.
std::shared_ptr<const Model> with_multipliers_as_coordinates(const Model& model) {
  auto result = std::make_shared<Model>(model);
  Lagrangian& own = result->lagrangian = copied(model.lagrangian);
  Graph& graph = *own.graph;
  std::vector<Replacement> no_forces;
  Expression terms = graph.number(0);
  for (std::size_t j = 0; j < own.constraints.size(); ++j) {
    const Expression& lambda = own.symbols.multipliers[j];
    const std::string name = multiplier_name(model.scene.constraints[j]);
    if (const auto& position = own.constraints[j].position) {
      no_forces.emplace_back(lambda, graph.number(0));
      terms = terms + lambda * *position;
    }
    own.symbols.coordinates.value.push_back(lambda);
    own.symbols.coordinates.rate.push_back(graph.symbol(name + "_dot"));
    own.symbols.coordinates.second_rate.push_back(graph.symbol(name + "_ddot"));
    result->scene.coordinates.push_back(
        {name, model.parsed.constraints[j].multiplier_unit, "", "", "", {}, "", ""});
  }
  for (Expression& force : own.generalized_forces) force = substitute(force, no_forces);
  own.generalized_forces.resize(own.symbols.coordinates.value.size(), graph.number(0));
  own.lagrangian = own.lagrangian + terms;
  if (own.potential_energy) own.potential_energy = *own.potential_energy - terms;
  own.symbols.multipliers.clear();
  own.constraints.clear();
  result->scene.constraints.clear();
  result->equations = {};
  result->parsed.graph = own.graph;
  result->parsed.symbols = own.symbols;
  return result;
}

void check_constraints(const Model& model, const Lagrangian& own, RestingPlace place) {
  for (std::size_t j = 0; j < model.scene.constraints.size(); ++j) {
    const ConstraintEquation& constraint = own.constraints[j];
    const std::string name = "'" + model.scene.constraints[j].name + "'";
    if (!constraint.position && place == RestingPlace::looked_for)
      undetermined_on_surface(
          name +
          " holds velocities, so that the system may rest in any place where the forces allow it. 'modes' "
          "has the small motions about one that 'initial' gives.");
    if (!is_workless(constraint, own.symbols))
      undetermined_on_surface(name + " moves, so that nothing rests.");
  }
}

}  // namespace

void undetermined_on_surface(const std::string& why) {
  throw Error(ErrorCode::not_applicable, "This is undetermined for a scene with constraints: " + why);
}

SurfaceStatics surface_statics(const Dynamics& dynamics, const Reals& parameters, RestingPlace place) {
  const Model& model = dynamics.model();
  const Lagrangian own = copied(model.lagrangian);
  check_constraints(model, own, place);
  if (!model.scene.inputs.empty()) undetermined_on_surface("inputs act on it.");
  if (dynamics.kinks() != nullptr) undetermined_on_surface("an abs() or a sign() stands in its forces.");
  if (has_forces_of_multipliers(own))
    undetermined_on_surface("a force depends on their reactions, as friction does.");
  SurfaceStatics result{model.degrees_of_freedom(), model.scene.constraints.size(),
                        std::make_unique<const Dynamics>(with_multipliers_as_coordinates(model)), nullptr};
  result.statics = result.dynamics->statics(parameters);
  result.coordinates -= result.statics->reduction.ignored.size();
  return result;
}

std::vector<double> with_multipliers(const Dynamics& dynamics, const Reals& parameters,
                                     const std::vector<double>& y) {
  const auto forces = values_at(dynamics, multiplier_columns(dynamics.model()), parameters, 0, y);
  std::vector<double> result(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(y.size() / 2));
  result.insert(result.end(), forces.begin(), forces.end());
  return result;
}

std::vector<Ball> constants_on_surface(const SurfaceStatics& whole, const Dynamics& dynamics,
                                       const Reals& parameters, const Reals& y) {
  std::vector<Ball> constants = parameters.as<Ball>();
  const std::vector<std::size_t>& ignored = whole.statics->reduction.ignored;
  if (ignored.empty()) return constants;
  std::vector<Ball> momenta(ignored.size());
  const auto function = dynamics.columns(momentum_columns(dynamics.model(), ignored));
  TapeEvaluator<Ball>(*function, parameters.as<Ball>())(y.as<Ball>(), momenta);
  constants.insert(constants.end(), momenta.begin(), momenta.end());
  return constants;
}

}  // namespace qdot
