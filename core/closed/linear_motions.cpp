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

LinearMotions linear_motions(const Reduction& reduction, const Scene& scene,
                             const std::vector<bool>& vanishes) {
  LinearMotions result;
  result.graph = std::make_shared<Graph>(*reduction.graph);
  Graph& graph = *result.graph;
  Reduction own = reduction;
  own.graph = result.graph;
  std::vector<Replacement> zeros;
  for (auto* symbols :
       {&own.x, &own.x_dot, &own.x_ddot, &own.constants, &own.ignored_rates, &own.equations}) {
    for (Expression& e : *symbols) e = graph.adopt(e);
  }
  for (std::size_t c = 0; c < own.ignored.size(); ++c) {
    const Expression& p = own.constants[own.constants.size() - own.ignored.size() + c];
    if (vanishes.empty() || vanishes[c])
      zeros.emplace_back(p, graph.number(0));
    else
      result.momenta.push_back(p);
  }
  if (!zeros.empty()) {
    for (Expression& e : own.equations) e = substitute(e, zeros);
    for (Expression& e : own.ignored_rates) e = substitute(e, zeros);
  }
  result.x = own.x;
  for (const std::size_t i : own.kept) result.units.push_back(scene.coordinates[i].unit);
  result.moving = own.kept;
  result.following = own.ignored;
  for (const Expression& e : own.equations) result.forces.push_back(at_rest(own, e));
  result.stiffness = derivatives(own, result.forces, own.x);
  result.mass = derivatives(own, own.equations, own.x_ddot);
  result.damping = derivatives(own, own.equations, own.x_dot);
  result.following_rates = derivatives(own, own.ignored_rates, own.x_dot);
  result.following_slopes = derivatives(own, own.ignored_rates, own.x);
  return result;
}

bool momenta_vanish(const Dynamics& dynamics, const Statics& statics, const Reals& parameters,
                    std::span<const double> y) {
  if (statics.reduction.ignored.empty()) return true;
  const auto columns = momentum_columns(dynamics.model(), statics.reduction.ignored);
  return std::ranges::all_of(values_at(dynamics, columns, parameters, 0, y), [](double p) { return p == 0; });
}

PlaceProblem place_problem(const LinearMotions& motions, ExactValues& values,
                           std::span<const Interval> near) {
  PlaceProblem problem{motions.x, {}, {}, {}, motions.surface, {near.begin(), near.end()}, values.sign_of()};
  problem.forces.insert(problem.forces.end(), motions.forces.begin(), motions.forces.end());
  const std::vector<Parameter>& parameters = values.model().scene.parameters;
  for (std::size_t k = 0; k < motions.x.size(); ++k) {
    values.set(motions.x[k], Real(near[k].middle(), 0, near[k].width()));
    problem.is_angle.push_back(motions.units[k] == "rad");
    problem.alike.emplace_back();
    for (std::size_t p = 0; p < parameters.size(); ++p) {
      if (parameters[p].unit == motions.units[k])
        problem.alike.back().push_back({values.symbols()[p], values.parameters()[p]});
    }
    problem.starts.emplace_back();
    // A multiplier has none, also where it is a coordinate of the surface's own system.
    const bool has_start =
        k < motions.moving.size() && motions.moving[k] < values.model().parsed.initial.size();
    const auto start = has_start ? values.coordinate(motions.moving[k]) : std::nullopt;
    if (start) problem.starts.back() = {*start, values.value(*start).value};
  }
  return problem;
}

std::vector<Interval> those_of(std::span<const Interval> all, std::span<const std::size_t> coordinates) {
  std::vector<Interval> result;
  for (const std::size_t i : coordinates) result.push_back(all[i]);
  return result;
}

}  // namespace qdot
