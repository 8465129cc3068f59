#include "core/turning/energy_problem.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/compile/tape_evaluator.hpp"
#include "core/expr/linear.hpp"
#include "core/expr/simplify.hpp"
#include "core/mechanics/canonical.hpp"

namespace qdot {
namespace {

/// The parameters and the momenta of the ignored coordinates, these with the rounding of their evaluation.
std::vector<Ball> enclosed_constants(const Dynamics& dynamics, const Statics& statics,
                                     const Reals& parameters, const Reals& y) {
  std::vector<Ball> constants = parameters.as<Ball>();
  if (statics.reduction.ignored.empty()) return constants;
  const auto function = dynamics.columns(momentum_columns(dynamics.model(), statics.reduction.ignored));
  std::vector<Ball> momenta(statics.reduction.ignored.size());
  TapeEvaluator<Ball>(*function, constants)(y.as<Ball>(), momenta);
  constants.insert(constants.end(), momenta.begin(), momenta.end());
  return constants;
}

/// The same without the momenta that are exactly 0: nothing is divided by what they were multiplied with.
Statics without_vanishing_momenta(const Statics& statics, std::span<const Ball> constants) {
  Reduction own = statics.reduction;
  own.graph = std::make_shared<Graph>(*statics.reduction.graph);
  Graph& graph = *own.graph;
  std::vector<Replacement> zeros;
  for (std::size_t i = constants.size() - own.ignored.size(); i < constants.size(); ++i) {
    if (constants[i].is_zero()) zeros.emplace_back(graph.adopt(own.constants[i]), graph.number(0));
  }
  const auto reduced = [&](const Expression& e) { return simplify(substitute(graph.adopt(e), zeros)); };
  const Expression x = graph.adopt(own.x[0]);
  own.x = {x};
  own.x_dot = {graph.adopt(own.x_dot[0])};
  own.x_ddot = {graph.adopt(own.x_ddot[0])};
  const Expression potential = reduced(Number(-1) * at_rest(own, graph.adopt(own.routhian)));
  const Expression force = simplify(differentiate(potential, x));
  const Expression inertia =
      reduced(at_rest(own, differentiate(graph.adopt(own.equations[0]), own.x_ddot[0])));
  const auto compiled = [&](const Expression& e) { return compiled_at_rest(own, graph, {&e, 1}); };
  Statics result;
  result.forces = compiled(force);
  result.stiffness = compiled(simplify(differentiate(force, x)));
  result.inertia = compiled(inertia);
  result.potential = compiled(potential);
  result.reduction = std::move(own);
  return result;
}

}  // namespace

std::string why_not_by_energy(const Dynamics& dynamics, const Reals& parameters, std::size_t coordinate) {
  std::shared_ptr<const Statics> statics;
  try {
    statics = dynamics.statics(parameters);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::not_applicable) throw;
    return dynamics.model().has_constraints() ? "the system has constraints"
                                              : "the time enters the equations of motion";
  }
  const Reduction& reduction = statics->reduction;
  if (reduction.degrees_of_freedom() != 1) {
    const std::size_t ignorable = ignorable_coordinates(dynamics.model().lagrangian).size();
    if (reduction.ignored.size() == ignorable)
      return "more than one coordinate is left after the ignorable ones";
    return ignorable > largest_written_system
               ? "there are more ignorable coordinates than can be eliminated by their momenta, which are three"
               : "the momentum of an ignorable coordinate is not linear in the velocities, and it stays";
  }
  if (reduction.kept[0] != coordinate) return "the coordinate is ignorable";
  if (!reduction.limits.empty()) return "the energy of the coordinate vanishes with its equation";
  if (!statics->potential) return "the forces do not leave the energy integral constant";
  if (!statics->quadratic) return "the energy is not quadratic in the velocity";
  return "";
}

EnergyProblem energy_problem(const Dynamics& dynamics, const Reals& parameters, const Reals& y) {
  EnergyProblem problem;
  problem.original = problem.statics = dynamics.statics(parameters);
  problem.coordinate = problem.original->reduction.kept[0];
  const std::string why_not = why_not_by_energy(dynamics, parameters, problem.coordinate);
  if (!why_not.empty()) {
    throw Error(ErrorCode::not_applicable,
                "There are no turning points without following the motion: " + why_not + ".");
  }
  problem.constants = enclosed_constants(dynamics, *problem.original, parameters, y);
  const auto momenta = std::span(problem.constants).subspan(parameters.size());
  if (std::ranges::any_of(momenta, [](const Ball& p) { return p.is_zero(); })) {
    problem.statics =
        std::make_shared<const Statics>(without_vanishing_momenta(*problem.original, problem.constants));
  }
  return problem;
}

}  // namespace qdot
