#include "core/steady/critical_growth.hpp"

#include <algorithm>
#include <cmath>

#include "core/steady/critical_sentences.hpp"
#include "core/steady/stability.hpp"

namespace qdot {
namespace {

/// omega^2 by the system's own formula.
std::optional<Interval> square_by_formula(const SteadyProblem& problem, const BifurcationSystems& systems,
                                          const CriticalZero& zero) {
  Box variables = zero.x, square(1);
  variables.push_back(zero.p);
  TapeEvaluator<Interval>(systems.square, problem.constants)(variables, square);
  return square[0].is_finite() ? std::optional(square[0]) : std::nullopt;
}

/// The pair nearest to the imaginary axis: the condition vanishes for real ones +-r, too.
std::optional<Interval> square_by_eigenvalues(const SteadyStability& at) {
  constexpr double rounding = 1e-6;
  if (at.eigenvalues.empty()) return std::nullopt;
  const auto distance = [](const SteadyStability::Eigenvalue& e) {
    const bool oscillates = std::abs(e.s.imag()) > e.error;
    return oscillates ? std::abs(e.s.real()) / std::abs(e.s.imag()) : infinity;
  };
  const auto nearest = std::ranges::min_element(at.eigenvalues, {}, distance);
  const double omega = std::abs(nearest->s.imag());
  const bool is_on_axis = distance(*nearest) * omega <= nearest->error + rounding * omega;
  return is_on_axis ? square(Interval(omega)) : Interval(-1);
}

}  // namespace

CriticalGrowth critical_growth(const Dynamics& dynamics, const SteadyProblem& problem,
                               const BifurcationSystems& systems, std::size_t index, const Interval& range,
                               const std::function<Box(const CriticalZero&)>& place_of) {
  CriticalGrowth result;
  if (systems.growth.empty()) return result;
  const CriticalZeros found = critical_zeros(dynamics.model(), problem, systems, systems.growth, range,
                                             [](std::span<const Interval>) { return false; });
  result.complete = found.complete && !found.undecided;
  const bool has_formula = systems.square.outputs() == 1;
  for (const CriticalZero& zero : found.zeros) {
    SteadyProblem here = problem;
    here.constants[index] = zero.p;
    const auto square = !zero.simple ? std::nullopt
                        : has_formula
                            ? square_by_formula(problem, systems, zero)
                            : square_by_eigenvalues(StabilityAnalysis(dynamics, here).at(place_of(zero)));
    result.complete = result.complete && square && !square->contains(0.0);
    if (!square || square->lower <= 0) continue;
    const bool is_degenerate = zero.kind == BifurcationSystem::Kind::degenerate_growth;
    const BifurcationKind kind = is_degenerate                 ? BifurcationKind::unresolved
                                 : systems.growth_is_collision ? BifurcationKind::flutter
                                                               : BifurcationKind::hopf;
    result.zeros.push_back({zero, kind, is_degenerate ? degenerate_growth : "",
                            has_formula ? std::optional(sqrt(*square)) : std::nullopt});
  }
  return result;
}

}  // namespace qdot
