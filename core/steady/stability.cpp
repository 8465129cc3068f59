#include "core/steady/stability.hpp"

#include <algorithm>

#include "core/expr/simplify.hpp"
#include "core/steady/free_direction.hpp"

namespace qdot {

StabilityAnalysis::StabilityAnalysis(const Dynamics& dynamics, const SteadyProblem& problem)
    : dynamics_(dynamics),
      problem_(problem),
      n_(problem_.statics->reduction.degrees_of_freedom()),
      inertia_(problem_.statics->inertia, problem_.constants),
      damping_(problem_.statics->damping, problem_.constants),
      stiffness_(problem_.forces->stiffness, problem_.constants) {}

std::vector<Interval> StabilityAnalysis::matrix(TapeEvaluator<Interval>& function,
                                                std::span<const Interval> x) const {
  std::vector<Interval> result(n_ * n_);
  function(x, result);
  return result;
}

bool StabilityAnalysis::has_inertia(std::span<const Interval> x) {
  const Inertia inertia = inertia_of(matrix(inertia_, x), n_);
  return inertia.undecided == 0 || inertia.negative > 0;
}

LinearizedForces StabilityAnalysis::linearized(std::span<const Interval> x) {
  return {n_,
          matrix(inertia_, x),
          matrix(damping_, x),
          matrix(stiffness_, x),
          problem_.forces->symmetric,
          problem_.forces->has_potential,
          problem_.forces->free};
}

StabilityAnalysis::Energy StabilityAnalysis::energy(std::span<const Interval> x) {
  const LinearizedForces at = linearized(x);
  const bool damped = n_ == 1 && at.rates[0].lower > 0;  // one force of one coordinate always has a potential
  return {has_potential(at) || (damped && inertia_of(at.mass, n_).positive == n_),
          !std::ranges::all_of(at.rates, is_zero) && !damped};
}

SteadyStability StabilityAnalysis::at(std::span<const Interval> x) {
  const LinearizedForces forces = linearized(x);
  SteadyStability result = linear_stability(forces, [&] { return next_terms(x); });
  if (result.stability != Stability::neutral || n_ < 2 || !has_linear_equations(*problem_.statics))
    return result;
  if (never_gains_energy(forces)) {
    result.stability = Stability::stable;
    result.undecided.clear();
  } else {
    result.undecided =
        "An eigenvalue of the equations, which are linear, is zero or imaginary to within rounding: 'modes' says of "
        "each motion whether it is known to neither grow nor decay.";
  }
  return result;
}

/// The signs of U''' and U'''' where U'' = 0 to within rounding. What follows from them holds where U'' = 0,
/// and of a number that only rounding hides it would be wrong.
std::string StabilityAnalysis::next_terms(std::span<const Interval> x) {
  const auto function = dynamics_.derived<CompiledFunction>(
      "third and fourth derivative", problem_.parameters, [](const Statics& statics) {
        const Reduction& reduction = statics.reduction;
        Graph graph(*reduction.graph);
        const Expression symbol = graph.adopt(reduction.x[0]);
        const Expression second = differentiate(graph.adopt(statics.rest[0]), symbol);
        const Expression third = simplify(differentiate(second, symbol));
        const Expression fourth = simplify(differentiate(third, symbol));
        return compiled_at_rest(reduction, graph, std::vector<Expression>{third, fourth});
      });
  std::vector<Interval> second(1), next(2);
  stiffness_(x, second);
  TapeEvaluator<Interval>(*function, problem_.constants)(x, next);
  const Interval& third = next[0];
  const Interval& fourth = next[1];
  const std::string start = "The second derivative of the effective potential is zero to within rounding; ";
  if (!third.contains(0.0)) {
    const char* where = is_zero(second[0]) ? "" : "where the second is zero, ";
    return start + "its third derivative is not: " + where + "unstable, to one side the force leads away.";
  }
  if (is_zero(third) && is_zero(fourth)) return start + "so are its third and fourth: undecided.";
  if (fourth.contains(0.0)) return start + "its third and fourth may be: undecided.";
  const char* where = is_zero(second[0]) && is_zero(third) ? "" : ", where both are zero";
  return start + "so is its third, and its fourth is " +
         (fourth.lower > 0 ? "positive: nonlinearly stable" : "negative: nonlinearly unstable") + where + ".";
}

}  // namespace qdot
