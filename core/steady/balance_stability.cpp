#include "core/steady/balance_stability.hpp"

#include "core/base/error.hpp"
#include "core/compile/tape_evaluator.hpp"
#include "core/numerics/root_isolation.hpp"
#include "core/steady/constrained_modes.hpp"
#include "core/steady/rolling_modes.hpp"
#include "core/steady/search_region.hpp"
#include "core/steady/steady_rolling.hpp"

namespace qdot {
namespace {

/// The unknown and the momenta are only known to lie in intervals. What vanishes does so exactly.
void enclose(const BalanceProblem& problem, const Interval& u, std::vector<Interval>& constants_at) {
  const SteadyPolynomial& polynomial = *problem.polynomial;
  std::vector<Interval> constants = problem.constants;
  constants[polynomial.place] = u;
  std::vector<Interval> momenta(polynomial.momenta.outputs());
  TapeEvaluator<Interval>(polynomial.momenta, constants)(problem.x, momenta);
  const std::size_t parameters = problem.parameters.size();
  if (problem.solves_for_parameter()) constants_at[polynomial.place] = u;
  if (constants_at.size() != parameters + momenta.size()) return;
  for (std::size_t k = 0; k < momenta.size(); ++k) {
    if (!is_zero(constants_at[parameters + k])) constants_at[parameters + k] = momenta[k];
  }
}

SteadyStability without_rolling(const BalanceProblem& problem, const Reals& parameters, const Reals& y,
                                const Interval& u) {
  const SurfaceStatics whole = surface_statics(problem.dynamics, parameters);
  std::vector<Interval> constants;
  for (const Ball& c : constants_on_surface(whole, problem.dynamics, parameters, y))
    constants.push_back(c.interval());
  enclose(problem, u, constants);
  std::vector<Ball> balls;
  for (const Interval& c : constants) balls.push_back(Ball::of(c));
  Box q;
  for (std::size_t k = 0; k < whole.coordinates; ++k)
    q.push_back(Interval::literal(y.exact(whole.statics->reduction.kept[k])));
  const std::vector<double> state(y.begin(), y.end());
  return surface_modes_at(whole, balls, q, state).stability;
}

SteadyStability on_surface(const BalanceProblem& problem, const Reals& parameters, const Reals& y,
                           const Interval& u) {
  SteadyStability result;
  try {
    if (!has_constraint_in_velocities(problem.dynamics.model()))
      return without_rolling(problem, parameters, y, u);
    const Modes modes = rolling_modes(problem.dynamics, parameters, y);
    result.stability = modes.stability;
    result.undecided = modes.undecided;
  } catch (const Error& error) {
    result.undecided = error.what();
  }
  return result;
}

SteadyStability without_constraints(const BalanceProblem& problem, const Reals& parameters, const Reals& y,
                                    const Interval& u) {
  SteadyProblem at_value = steady_problem(problem.dynamics, parameters, y);
  enclose(problem, u, at_value.constants);
  Box x;  // where the value vanishes, other coordinates may be ignorable
  for (const std::size_t i : at_value.statics->reduction.kept)
    x.push_back(Interval::literal(problem.y.exact(i)));
  return StabilityAnalysis(problem.dynamics, at_value).at(x);
}

}  // namespace

SteadyStability balance_stability(const BalanceProblem& problem, const Interval& u, double value) {
  Reals parameters = problem.parameters;
  Reals y = problem.y;
  for (const std::size_t i : problem.reduction().kept) {
    if (!problem.is_multiplier(i)) y.set(y.size() / 2 + i, 0);
  }
  const auto set_unknown = [&](const auto& to) {
    if (problem.solves_for_parameter()) {
      parameters.set(problem.polynomial->place, to);
    } else {
      y.set(problem.velocity_place(), to);
    }
  };
  if (!problem.position.surface) {
    set_unknown(value);
    return without_constraints(problem, parameters, y, u);
  }
  set_unknown(Real{value, 0, distance_bound(value, u)});
  return on_surface(problem, parameters, y, u);
}

}  // namespace qdot
