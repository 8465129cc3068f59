#include "core/steady/search_region.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

/// Zeros like to lie at 0 and pi: the region's ends lie beside them.
constexpr double offset = 0.03;

Interval full_turn() { return {std::nextafter(2 * pi, 0), std::nextafter(2 * pi, 7)}; }

}  // namespace

Box search_region(const Model& model, const SteadyProblem& problem) {
  return search_region(model, problem, problem.forces->unknowns);
}

Box search_region(const Model& model, const SteadyProblem& problem, std::span<const std::size_t> unknowns) {
  Box region;
  for (const std::size_t j : unknowns) {
    const Domain& domain = model.scene.coordinates[problem.statics->reduction.kept[j]].domain;
    const Interval all{std::max(domain.lower, -largest_length), std::min(domain.upper, largest_length)};
    // A little more than a turn, in which rounding may not leave a gap.
    const Interval turn{-pi - offset, pi - offset + 2e-9};
    region.push_back(problem.forces->turns[j] && all.contains(turn) ? turn : all);
  }
  return region;
}

Interval reduced_angle(const Interval& any) {
  const double turns = std::round(any.middle() / (2 * pi));
  const bool is_far = std::isfinite(turns) && std::abs(turns) > 1;
  const Interval angle = is_far ? any - Interval(turns) * full_turn() : any;
  if (angle.lower <= -pi) return angle + full_turn();
  return angle.upper > pi && !angle.contains(pi) ? angle - full_turn() : angle;
}

double representative(const Interval& x) {
  if (x.contains(0.0)) return 0;
  return x.contains(pi) ? pi : x.middle();
}

double distance_bound(double x, const Interval& enclosure) {
  if (enclosure.lower == x && enclosure.upper == x) return 0;
  return std::nextafter(std::max(x - enclosure.lower, enclosure.upper - x), infinity);
}

}  // namespace qdot
