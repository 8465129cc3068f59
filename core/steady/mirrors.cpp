#include "core/steady/mirrors.hpp"

#include <algorithm>
#include <numbers>

#include "core/compile/tape_evaluator.hpp"

namespace qdot {
namespace {

/// The derivatives of the even forces along the unknowns that keep their signs have a determinant other
/// than 0 everywhere in the enclosure; at most two of each.
bool is_regular_along(const Mirror& mirror, const SteadyProblem& problem, const BifurcationSystems& systems,
                      const CriticalZero& here) {
  const std::size_t n = here.x.size();
  std::vector<std::size_t> kept_signs;
  for (std::size_t j = 0; j < n; ++j) {
    if (std::ranges::find(mirror.turned, j) == mirror.turned.end()) kept_signs.push_back(j);
  }
  if (kept_signs.size() != mirror.even.size() || kept_signs.size() > 2) return false;
  if (kept_signs.empty()) return true;
  Box place = here.x, slopes(systems.slopes.outputs());
  place.push_back(here.p);
  TapeEvaluator<Interval>(systems.slopes, problem.constants)(place, slopes);
  const auto entry = [&](std::size_t i, std::size_t j) {
    return slopes[mirror.even[i] * (n + 1) + kept_signs[j]];
  };
  const Interval determinant =
      kept_signs.size() == 1 ? entry(0, 0) : entry(0, 0) * entry(1, 1) - entry(0, 1) * entry(1, 0);
  return !determinant.contains(0.0);
}

}  // namespace

bool is_on_mirror(const SteadyProblem& problem, const BifurcationSystems& systems, const CriticalZero& here) {
  return std::ranges::any_of(systems.mirrors, [&](const Mirror& mirror) {
    const bool on_it = std::ranges::all_of(mirror.turned, [&](std::size_t j) {
      const bool turns = problem.forces->turns[systems.unknowns[j]];
      return here.x[j].contains(0.0) || (turns && here.x[j].contains(std::numbers::pi));
    });
    return on_it && is_regular_along(mirror, problem, systems, here);
  });
}

}  // namespace qdot
