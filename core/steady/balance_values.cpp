#include "core/steady/balance_values.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "core/compile/tape_evaluator.hpp"
#include "core/steady/quadratic_roots.hpp"
#include "core/steady/search_along_unknown.hpp"
#include "core/steady/values_along_unknown.hpp"

namespace qdot {
namespace {

[[nodiscard]] bool is_at_kink(const BalanceProblem& problem) {
  const SmoothForces& at_rest = problem.kinks->at_rest;
  std::vector<Interval> variables = problem.near, u(at_rest.kinks());
  variables.resize(variables.size() + u.size(), Interval(-1, 1));
  TapeEvaluator<Interval>(at_rest.arguments, problem.constants)(variables, u);
  return std::ranges::any_of(u, [](const Interval& argument) { return argument.contains(0.0); });
}

[[nodiscard]] bool has_no_value(const BalanceProblem& problem) {
  const CompiledFunction& function = problem.polynomial->divisors;
  std::vector<Interval> divisors(function.outputs());
  TapeEvaluator<Interval>(function, problem.constants)(problem.x, divisors);
  return std::ranges::any_of(divisors, [](const Interval& divisor) { return divisor.contains(0.0); });
}

/// Of the constraints' slopes all determinants may vanish at the position.
[[nodiscard]] bool are_dependent(const BalanceProblem& problem, std::span<const Interval> constants) {
  if (!problem.position.on_surface) return false;
  const CompiledFunction& determinants = problem.position.on_surface->determinants;
  std::vector<Interval> d(determinants.outputs());
  TapeEvaluator<Interval>(determinants, constants)(problem.x, d);
  return std::ranges::all_of(d, [](const Interval& one) { return one.contains(0.0); });
}

/// Of a force that no u makes vanish.
[[nodiscard]] Candidates out_of_balance(const BalanceProblem& problem, const SteadyPolynomial::Force& force) {
  const std::vector<std::size_t>& kept = problem.reduction().kept;
  const Scene& scene = problem.scene();
  if (!problem.position.surface)
    return {Obstacle::not_in_balance, {}, scene.coordinates[kept[force.equation]].name, 0};
  const auto sets = sets_of_forces(*problem.position.surface);
  if (force.equation >= sets.size())
    return {Obstacle::off_surface, {}, scene.constraints[force.equation - sets.size()].name, 0};
  std::string names;
  for (const std::size_t k : sets[force.equation])
    names += (names.empty() ? "" : ", ") + scene.coordinates[kept[k]].name;
  return {Obstacle::not_in_balance, {}, "What acts along " + names, 0};
}

struct Nearby {
  std::vector<Interval> at;    ///< the position
  std::vector<Interval> near;  ///< and no farther from it than the doubles next to it

  /// Of force k, where these are the coefficients of 1, u, u^2 for each force.
  [[nodiscard]] std::pair<std::span<const Interval>, std::span<const Interval>> of_force(
      std::size_t k) const {
    return {std::span(at).subspan(3 * k, 3), std::span(near).subspan(3 * k, 3)};
  }
};

/// A function's values. In twice the digits, and beside the position by differences: terms of (x - 1)^5 that
/// are multiplied out are rounded by more than it is at 1.001. `others`: its variables after the position.
[[nodiscard]] Nearby values_nearby(const BalanceProblem& problem, const CompiledFunction& function,
                                   std::vector<Ball> others = {}) {
  const std::size_t n = problem.y.size() / 2;
  std::vector<Ball> constants = problem.parameters.as<Ball>(), x;
  for (const std::size_t c : problem.reduction().ignored)
    constants.push_back(Ball::literal(problem.y.exact(n + c)));
  for (const std::size_t i : problem.reduction().kept)
    x.push_back(problem.is_multiplier(i) ? Ball(0) : Ball::literal(problem.y.exact(i)));
  const std::size_t coordinates = x.size();
  x.insert(x.end(), others.begin(), others.end());
  TapeEvaluator<Ball> evaluate(function, constants);
  std::vector<Ball> here(function.outputs()), there(here.size());
  evaluate(x, here);
  std::vector<double> moved(here.size());
  for (std::size_t i = 0; i < coordinates; ++i) {
    std::vector<Ball> beside = x;
    beside[i] = x[i] + Ball(problem.near[i].upper - problem.near[i].middle());
    evaluate(beside, there);
    for (std::size_t k = 0; k < here.size(); ++k) moved[k] += (there[k] - here[k]).magnitude();
  }
  Nearby result;
  for (std::size_t k = 0; k < here.size(); ++k) {
    result.at.push_back(here[k].is_finite() ? here[k].interval() : Interval::whole());
    result.near.push_back(result.at[k] + Interval(-moved[k], moved[k]));
  }
  return result;
}

[[nodiscard]] Candidates roots(std::span<const Interval> c, std::span<const Interval> near) {
  QuadraticRoots found = quadratic_roots(c, near);
  using Outcome = QuadraticRoots::Outcome;
  static const std::map<Outcome, Obstacle> obstacles{{Outcome::found, Obstacle::none},
                                                     {Outcome::undefined, Obstacle::undefined},
                                                     {Outcome::at_infinity, Obstacle::no_finite_value},
                                                     {Outcome::not_real, Obstacle::no_real_value},
                                                     {Outcome::negative_square, Obstacle::negative_square}};
  Candidates candidates{obstacles.at(found.outcome), {}, "", found.square};
  for (const Interval& u : found.values) candidates.values.push_back({u, !found.may_be_two});
  return candidates;
}

/// Whether the functions have values at u, or just beside it, as a root has at the end of its domain.
[[nodiscard]] bool have_values(const BalanceProblem& problem, const CompiledFunction& functions,
                               const Interval& u) {
  return std::ranges::any_of(std::array{u.lower, u.middle(), u.upper}, [&](double at) {
    const Nearby values = values_nearby(problem, functions, {Ball(at)});
    return std::ranges::all_of(values.at, &Interval::is_finite);
  });
}

/// Of the forces at all values of u, by their slopes along it: a square that hardly vanishes does not there.
[[nodiscard]] std::vector<Interval> forces_over(const BalanceProblem& problem, const Interval& u) {
  const double middle = u.middle();
  std::vector<Interval> place = problem.x;
  place.push_back(u);
  std::vector<Interval> values = values_nearby(problem, problem.polynomial->values, {Ball(middle)}).near;
  std::vector<Interval> slopes(values.size());
  TapeEvaluator<Interval>(problem.polynomial->derivatives, problem.constants)(place, slopes);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = values[k] + slopes[k] * (u - Interval(middle));
  return values;
}

[[nodiscard]] bool satisfies_others(const BalanceProblem& problem, const Interval& u, std::size_t chosen) {
  const CompiledFunction& functions = problem.polynomial->values;
  const Nearby values = values_nearby(problem, functions, {Ball::of(u)});
  const std::vector<Interval> by_slopes = forces_over(problem, u);
  const bool are_finite = std::ranges::all_of(values.at, &Interval::is_finite);
  for (std::size_t k = 0; k < values.near.size(); ++k) {
    if (k == chosen) continue;
    const bool is_other_than_zero = by_slopes[k].is_finite() && !by_slopes[k].contains(0.0);
    if (!values.near[k].contains(0.0) || (are_finite && is_other_than_zero)) return false;
  }
  return are_finite || have_values(problem, functions, u);
}

/// The zeros of one force that are zeros of all, and where all have values.
[[nodiscard]] Candidates common_zeros(const BalanceProblem& problem, Candidates found, std::size_t chosen) {
  std::erase_if(found.values,
                [&](const BalancingValue& value) { return !satisfies_others(problem, value.u, chosen); });
  const bool depend = std::ranges::any_of(found.values, [&](const BalancingValue& value) {
    std::vector<Interval> constants = problem.constants;
    constants[problem.polynomial->place] = value.u;
    return are_dependent(problem, constants);
  });
  if (depend) return {Obstacle::dependent, {}, "", 0};
  if (found.values.empty() && found.obstacle == Obstacle::none) found.obstacle = Obstacle::no_common_value;
  return without_poles(problem, std::move(found), chosen);
}

enum class Demand { nothing, impossible, a_value };

/// What a force asks of u, by its coefficients c at the position and near it. `alone`: no other force could
/// tell u where this one hardly depends on it.
[[nodiscard]] Demand demand_of(const SteadyPolynomial::Force& force, std::span<const Interval> c,
                               std::span<const Interval> near, bool alone) {
  const auto vanishes = [near](std::size_t power) { return near[power].contains(0.0); };
  const bool is_constant = force.degree && is_zero(c[1]) && is_zero(c[2]);
  const bool is_flat = force.degree && vanishes(1) && vanishes(2);
  if (force.depends && !is_constant && !is_flat) return Demand::a_value;
  if (vanishes(0)) return Demand::nothing;
  return force.depends && !is_constant && alone ? Demand::a_value : Demand::impossible;
}

double widest(std::span<const BalancingValue> values) {
  double width = 0;
  for (const BalancingValue& value : values) width = std::max(width, value.u.width());
  return width;
}

struct Told {
  Candidates found;
  std::size_t force{};
};

/// By the force that tells u best: two roots of a polynomial may be too near to each other to be told apart,
/// where another has one. A force that is no polynomial is asked where none is, or where none tells.
[[nodiscard]] Told told_best(const BalanceProblem& problem, const Nearby& coefficients,
                             std::span<const std::size_t> asking) {
  const std::vector<SteadyPolynomial::Force>& forces = problem.polynomial->forces;
  Told best{{Obstacle::not_decided, {}, "", 0}, asking.front()};
  for (const std::size_t k : asking) {
    const bool is_told = best.found.obstacle == Obstacle::none;
    if (is_told && !forces[k].degree) break;
    const auto [c, near] = coefficients.of_force(k);
    Candidates now = forces[k].degree ? roots(c, near) : search_along_unknown(problem, k);
    if (now.obstacle == Obstacle::not_decided) continue;
    if (now.obstacle != Obstacle::none) return {std::move(now), k};
    if (!is_told || widest(now.values) < widest(best.found.values)) best = {std::move(now), k};
  }
  return best;
}

}  // namespace

/// A force that vanishes there whatever u is tells nothing: others may.
Candidates balancing_values(const BalanceProblem& problem) {
  if (problem.kinks->move || is_at_kink(problem)) return {Obstacle::at_kink, {}, "", 0};
  if (are_dependent(problem, problem.constants)) return {Obstacle::dependent, {}, "", 0};
  if (has_no_value(problem)) return {Obstacle::undefined, {}, "", 0};
  const std::vector<SteadyPolynomial::Force>& forces = problem.polynomial->forces;
  const Nearby coefficients = values_nearby(problem, problem.polynomial->coefficients);
  std::vector<std::size_t> without_force;
  std::vector<std::size_t> asking;
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const auto [c, near] = coefficients.of_force(k);
    const Demand demand = demand_of(forces[k], c, near, forces.size() == 1);
    if (demand == Demand::impossible) return out_of_balance(problem, forces[k]);
    if (demand == Demand::nothing) without_force.push_back(k);
    if (demand == Demand::a_value) asking.push_back(k);
  }
  if (asking.empty()) return {Obstacle::does_not_matter, {}, "", 0};
  std::stable_partition(asking.begin(), asking.end(),
                        [&](std::size_t k) { return forces[k].degree.has_value(); });
  Told told = told_best(problem, coefficients, asking);
  for (const std::size_t k : asking) {
    if (k != told.force && !forces[k].degree) without_force.push_back(k);
  }
  told.found.without_force = std::move(without_force);
  return common_zeros(problem, std::move(told.found), told.force);
}

}  // namespace qdot
