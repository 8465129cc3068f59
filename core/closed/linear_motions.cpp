#include "core/closed/linear_motions.hpp"

#include <algorithm>

namespace qdot {
namespace {

Matrix derivatives(const Reduction& reduction, const std::vector<Expression>& rows,
                   const std::vector<Expression>& variables) {
  Matrix result;
  for (const Expression& row : rows) {
    result.emplace_back();
    for (const Expression& v : variables) result.back().push_back(at_rest(reduction, differentiate(row, v)));
  }
  return result;
}

}  // namespace

LinearMotions linear_motions(const Statics& statics, bool momenta_vanish) {
  LinearMotions result;
  result.graph = std::make_shared<Graph>(*statics.reduction.graph);
  Graph& graph = *result.graph;
  Reduction own = statics.reduction;
  own.graph = result.graph;
  std::vector<Replacement> zeros;
  for (auto* symbols :
       {&own.x, &own.x_dot, &own.x_ddot, &own.constants, &own.ignored_rates, &own.equations}) {
    for (Expression& e : *symbols) e = graph.adopt(e);
  }
  if (momenta_vanish) {
    for (std::size_t i = own.constants.size() - own.ignored.size(); i < own.constants.size(); ++i)
      zeros.emplace_back(own.constants[i], graph.number(0));
    for (Expression& e : own.equations) e = substitute(e, zeros);
    for (Expression& e : own.ignored_rates) e = substitute(e, zeros);
  }
  result.x = own.x;
  for (const Expression& e : own.equations) result.forces.push_back(at_rest(own, e));
  result.stiffness = derivatives(own, result.forces, own.x);
  result.mass = derivatives(own, own.equations, own.x_ddot);
  result.damping = derivatives(own, own.equations, own.x_dot);
  result.ignored_rates = derivatives(own, own.ignored_rates, own.x_dot);
  result.ignored_slopes = derivatives(own, own.ignored_rates, own.x);
  return result;
}

bool momenta_vanish(const Dynamics& dynamics, const Statics& statics, const Reals& parameters,
                    std::span<const double> y) {
  if (statics.reduction.ignored.empty()) return true;
  const auto columns = momentum_columns(dynamics.model(), statics.reduction.ignored);
  return std::ranges::all_of(values_at(dynamics, columns, parameters, 0, y), [](double p) { return p == 0; });
}

PlaceProblem place_problem(const LinearMotions& motions, const Statics& statics, const ExactValues& values,
                           std::span<const Interval> near) {
  PlaceProblem problem{motions.x, {}, motions.forces, {}, {}, {}, values.sign_of()};
  const Scene& scene = values.model().scene;
  for (const std::size_t i : statics.reduction.kept) {
    problem.is_angle.push_back(scene.coordinates[i].unit == "rad");
    problem.near.push_back(near[i]);
  }
  for (std::size_t i = 0; i < scene.parameters.size(); ++i) {
    if (scene.parameters[i].unit != "rad") continue;
    problem.offsets.push_back(values.symbols()[i]);
    problem.offset_values.push_back(values.parameters()[i]);
  }
  return problem;
}

}  // namespace qdot
