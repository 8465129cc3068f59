#include "core/steady/critical_problem.hpp"

#include <algorithm>

#include "core/steady/followed_momenta.hpp"

namespace qdot {
namespace {

/// A parameter that is 0 counts as vanishing.
Reals not_vanishing(Reals parameters, std::size_t index, const Interval& range) {
  if (parameters[index] == 0) parameters.set(index, range.upper != 0 ? range.upper : range.lower);
  return parameters;
}

}  // namespace

CriticalProblem::CriticalProblem(const Dynamics& dynamics, const Reals& given, const Reals& y,
                                 std::size_t index, const Interval& range)
    : dynamics_(dynamics), y_(y.begin(), y.end()), index_(index) {
  const Reals parameters = not_vanishing(given, index, range);
  if (dynamics.model().has_constraints()) surface_.emplace(surface_problem(dynamics, parameters, y));
  problem_ = surface_ ? surface_->steady : steady_problem(dynamics, parameters, y);
  const auto followed = surface_ ? nullptr : with_followed_momenta(dynamics, parameters, {given, y}, index);
  if (followed) follow(followed);
  kept_ = problem_.statics->reduction.kept;
  if (surface_) {
    kept_.resize(surface_->whole.coordinates);
    add_charts(problem_.forces, *surface_->whole.dynamics);
    return;
  }
  if (problem_.forces->equations.size() != problem_.forces->unknowns.size()) {
    charts_.push_back({problem_, nullptr, {}});
    return;
  }
  if (followed) {
    const Reduction& reduction = problem_.statics->reduction;
    charts_.push_back({problem_,
                       std::make_shared<const BifurcationSystems>(derive_bifurcation_systems(
                           dynamics.model().scene, reduction, *problem_.forces, index)),
                       {}});
    return;
  }
  const std::span momenta = std::span(problem_.constants).subspan(parameters.size());
  const std::string key = "bifurcations " + dynamics.model().scene.parameters[index].name +
                          vanishing_momenta(*problem_.statics, momenta).key;
  const auto systems = dynamics.derived<BifurcationSystems>(key, parameters, [&](const Statics& statics) {
    return derive_bifurcation_systems(dynamics.model().scene, statics.reduction, *problem_.forces, index);
  });
  charts_.push_back({problem_, systems, {}});
}

/// Momenta that are expressions of the parameter, instead of numbers.
void CriticalProblem::follow(std::shared_ptr<const Statics> statics) {
  problem_.statics = std::move(statics);
  problem_.forces =
      std::make_shared<const SteadyForces>(derive_steady_forces(dynamics_.model(), *problem_.statics, {}));
}

/// Charts with the same equations are one.
void CriticalProblem::add_charts(std::shared_ptr<const SteadyForces> forces, const Dynamics& dynamics) {
  for (std::size_t k = 0; k < forces->charts.size(); ++k) {
    const std::vector<std::size_t>& equations = forces->charts[k].equations;
    const auto same = std::ranges::find_if(
        charts_, [&](const CriticalChart& chart) { return chart.problem.forces->equations == equations; });
    if (same != charts_.end()) {
      same->determinants.push_back(k);
      continue;
    }
    auto own = std::make_shared<SteadyForces>(*forces);
    own->equations = equations;
    CriticalChart chart{problem_, nullptr, {k}};
    chart.problem.forces = own;
    if (equations.size() == own->unknowns.size()) {
      chart.systems = std::make_shared<const BifurcationSystems>(
          derive_bifurcation_systems(dynamics.model().scene, problem_.statics->reduction, *own, index_));
    }
    charts_.push_back(std::move(chart));
  }
}

Equilibria CriticalProblem::at(double p) {
  SteadyProblem here = problem_;
  here.constants[index_] = p;
  if (p != 0) here.parameters.set(index_, p);
  if (!surface_) return equilibria(dynamics_, here, y_);
  surface_->steady = std::move(here);
  surface_->constants[index_] = Ball(p);
  return constrained_equilibria(*surface_).found;
}

Box CriticalProblem::place_of(const CriticalChart& chart, const CriticalZero& zero) const {
  const std::vector<std::size_t>& unknowns = chart.problem.forces->unknowns;
  Box variables = zero.x, values(unknowns.size());
  variables.push_back(zero.p);
  TapeEvaluator<Interval>(chart.systems->values, problem_.constants)(variables, values);
  Box place(problem_.statics->reduction.x.size());
  for (std::size_t k = 0; k < kept_.size(); ++k) place[k] = Interval(y_[kept_[k]]);
  for (std::size_t k = 0; k < values.size(); ++k) place[unknowns[k]] = values[k];
  return place;
}

CriticalProblem::Place CriticalProblem::place_in(const CriticalChart& chart, const CriticalZero& zero) const {
  if (chart.determinants.empty()) return Place::here;
  std::vector<Interval> constants = problem_.constants;
  constants[index_] = zero.p;
  Box d(problem_.forces->charts.size());
  TapeEvaluator<Interval>(problem_.forces->determinants, constants)(place_of(chart, zero), d);
  const auto is_own = [&](std::size_t k) {
    return std::ranges::find(chart.determinants, k) != chart.determinants.end();
  };
  double own = 0, other = 0;
  for (std::size_t k = 0; k < d.size(); ++k) {
    double& largest = is_own(k) ? own : other;
    largest = std::max(largest, d[k].contains(0.0) ? 0.0 : d[k].least_magnitude());
  }
  if (own == 0 && other == 0) return Place::singular;
  return own > 0 && 2 * own >= other ? Place::here : Place::in_another_chart;
}

}  // namespace qdot
