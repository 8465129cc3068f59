#include "core/steady/solve_for.hpp"

#include <algorithm>
#include <cmath>

#include "core/mechanics/moments.hpp"
#include "core/steady/balance_stability.hpp"
#include "core/steady/balance_values.hpp"
#include "core/steady/search_region.hpp"

namespace qdot {
namespace {

std::string position_in_words(const BalanceProblem& problem) {
  std::string text;
  for (const std::size_t j : problem.polynomial->needed) {
    const std::size_t i = problem.reduction().kept[j];
    text += (text.empty() ? "" : ", ") + problem.scene().coordinates[i].name + " = " +
            short_number(problem.y[i], 6);
  }
  return text;
}

bool is_allowed(const Domain& domain, const Interval& u) {
  if (domain.contains(representative(u))) return true;
  const Interval inside = intersection(u, {domain.lower, domain.upper});
  return !is_empty(inside) && inside.width() > 0;
}

SolvedValue solved(const BalanceProblem& problem, const BalancingValue& found) {
  const Interval& u = found.u;
  const Domain& domain = problem.domain;
  SolvedValue result;
  result.is_one = found.is_one;
  result.value = representative(u);
  if (!domain.contains(result.value)) result.value = intersection(u, {domain.lower, domain.upper}).middle();
  result.error = distance_bound(result.value, u);
  result.stability = balance_stability(problem, u, result.value);
  return result;
}

/// What is so of no body with this value.
std::optional<std::string> impossible_with(const BalanceProblem& problem, const Interval& u) {
  if (!problem.solves_for_parameter()) return std::nullopt;
  Reals parameters = problem.parameters;
  parameters.set(problem.polynomial->place, {u.middle(), 0, u.width()});
  return impossible_moment(problem.dynamics.model().parsed, parameters);
}

std::vector<SolvedValue> allowed_values(const BalanceProblem& problem,
                                        const std::vector<BalancingValue>& found) {
  std::vector<SolvedValue> values;
  for (const BalancingValue& value : found) {
    const Interval& u = value.u;
    if (is_allowed(problem.domain, u) && u.is_finite() && !impossible_with(problem, u))
      values.push_back(solved(problem, value));
  }
  std::sort(values.begin(), values.end(), [](const SolvedValue& a, const SolvedValue& b) {
    if ((a.value >= 0) != (b.value >= 0)) return a.value >= 0;
    return std::abs(a.value) < std::abs(b.value);
  });
  return values;
}

void tell_why_none_is_allowed(const BalanceProblem& problem, Candidates& found) {
  const auto inside = std::ranges::find_if(found.values, [&](const BalancingValue& value) {
    return value.u.is_finite() && is_allowed(problem.domain, value.u);
  });
  const bool is_inside = inside != found.values.end();
  found.number = (is_inside ? *inside : found.values[0]).u.middle();
  found.obstacle = is_inside ? Obstacle::impossible_body : Obstacle::outside_domain;
  if (is_inside) found.name = impossible_with(problem, inside->u).value_or("");
}

/// Velocities of ignorable coordinates stay as they are, also where the start gives them by the unknown.
std::string held_rates(const BalanceProblem& problem) {
  const Model& model = problem.dynamics.model();
  std::string text;
  if (!problem.solves_for_parameter()) return text;
  const Expression& u = model.parsed.symbols.parameters[problem.polynomial->place];
  for (const std::size_t c : problem.reduction().ignored) {
    if (problem.is_multiplier(c) || !depends_on(model.parsed.initial_rates[c], u)) continue;
    const std::string rate = model.scene.coordinates[c].name + "_dot";
    text += " " + rate + " stays " + short_number(problem.y[problem.y.size() / 2 + c], 6) +
            " here, though the start gives it by " + problem.unknown + ": solve for " + rate + " instead.";
  }
  return text;
}

}  // namespace

std::vector<std::string> solvable_names(const Dynamics& dynamics, const Reals& parameters) {
  const Scene& scene = dynamics.model().scene;
  std::vector<std::string> names;
  for (const Parameter& p : scene.parameters) names.push_back(p.name);
  const PositionStatics position = position_statics(dynamics, parameters);
  for (const std::size_t c : position.statics->reduction.ignored) {
    names.push_back(scene.coordinates[c].name + "_dot");
  }
  return names;
}

std::vector<std::size_t> needed_coordinates(const Dynamics& dynamics, const Reals& parameters,
                                            const std::string& unknown) {
  const Reals with = with_unknown(dynamics.model().scene, parameters, unknown);
  const PositionStatics position = position_statics(dynamics, with);
  const auto polynomial = polynomial_of(dynamics, position, with, unknown);
  std::vector<std::size_t> needed;
  for (const std::size_t j : polynomial->needed) {
    needed.push_back(position.statics->reduction.kept[j]);
  }
  return needed;
}

Solution solve_for(const Dynamics& dynamics, const Reals& parameters, const Reals& y,
                   const std::string& unknown) {
  const BalanceProblem problem = balance_problem(dynamics, parameters, y, unknown);
  Candidates found = balancing_values(problem);
  Solution result;
  result.polynomial = problem.polynomial;
  result.without_force = found.without_force;
  result.values = allowed_values(problem, found.values);
  if (result.values.empty() && !found.values.empty()) tell_why_none_is_allowed(problem, found);
  result.reason = sentence(found, unknown, position_in_words(problem));
  if (!result.reason.empty()) result.reason += held_rates(problem);
  if (problem.kinks->at_rest.kinks() > 0) return result;  // ranges would end at kinks, too
  const Domain& of_position = problem.scene().coordinates[problem.reduction().kept[0]].domain;
  result.ranges = solvable_ranges(*problem.polynomial, problem.constants, problem.domain, of_position);
  return result;
}

}  // namespace qdot
