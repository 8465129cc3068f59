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

constexpr double off_by_rounding = 1e-6;  ///< of eigenvalues near the axis, relative

using Eigenvalue = SteadyStability::Eigenvalue;

/// How far it is off the imaginary axis, relative; not finite for real ones.
double off_axis(const Eigenvalue& e) {
  const bool oscillates = std::abs(e.s.imag()) > e.error;
  return oscillates ? std::abs(e.s.real()) / std::abs(e.s.imag()) : infinity;
}

bool is_on_axis(const Eigenvalue& e) {
  const double omega = std::abs(e.s.imag());
  return off_axis(e) * omega <= e.error + off_by_rounding * omega;
}

/// omega^2 of the pair of eigenvalues nearest to the imaginary axis; the condition vanishes for a real pair
/// +-r, too.
std::optional<Interval> square_by_eigenvalues(const SteadyStability& at) {
  if (at.eigenvalues.empty()) return std::nullopt;
  const auto nearest = std::ranges::min_element(at.eigenvalues, {}, off_axis);
  return is_on_axis(*nearest) ? square(Interval(nearest->s.imag())) : Interval(-1);
}

/// Several pairs of eigenvalues cross the axis together. The formula knows one omega: it counts where all
/// have it.
struct CrossingTogether {
  bool is_known{}, oscillates{};
  std::optional<Interval> omega;
};

CrossingTogether crossing_together(const SteadyStability& at, const std::optional<Interval>& formula) {
  CrossingTogether result;
  result.is_known = !at.eigenvalues.empty() && std::ranges::all_of(at.eigenvalues, [](const Eigenvalue& e) {
    return std::isfinite(e.error);
  });
  if (formula && formula->lower > 0) result.omega = sqrt(*formula);
  for (const Eigenvalue& e : at.eigenvalues) {
    if (!is_on_axis(e)) continue;
    result.oscillates = true;
    const double omega = std::abs(e.s.imag());
    if (result.omega && std::abs(result.omega->middle() - omega) > e.error + off_by_rounding * omega)
      result.omega.reset();
  }
  return result;
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
    const auto stability = [&] { return StabilityAnalysis(dynamics, here).at(place_of(zero)); };
    const auto formula =
        zero.simple && has_formula ? square_by_formula(problem, systems, zero) : std::nullopt;
    if (zero.simple && zero.kind == BifurcationSystem::Kind::degenerate_growth) {
      const CrossingTogether pairs = crossing_together(stability(), formula);
      result.complete = result.complete && pairs.is_known;
      if (pairs.oscillates)
        result.zeros.push_back({zero, BifurcationKind::unresolved, degenerate_growth, pairs.omega});
      continue;
    }
    const auto square = !zero.simple  ? std::nullopt
                        : has_formula ? formula
                                      : square_by_eigenvalues(stability());
    result.complete = result.complete && square && !square->contains(0.0);
    if (!square || square->lower <= 0) continue;
    const BifurcationKind kind =
        systems.growth_is_collision ? BifurcationKind::flutter : BifurcationKind::hopf;
    result.zeros.push_back({zero, kind, "", has_formula ? std::optional(sqrt(*square)) : std::nullopt});
  }
  return result;
}

}  // namespace qdot
