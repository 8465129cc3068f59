#include "core/steady/bounded_state.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/steady/search_region.hpp"

namespace qdot {

BoundedState bounded_state(const SteadyProblem& problem, std::span<const Interval> constants,
                           std::span<const double> y, const Box& x) {
  const Reduction& reduction = problem.statics->reduction;
  const std::size_t n = y.size() / 2;
  BoundedState state{{y.begin(), y.begin() + static_cast<std::ptrdiff_t>(n)}, std::vector<double>(2 * n)};
  state.y.resize(2 * n, 0.0);
  const auto set = [&](std::size_t i, const Interval& value) {
    state.y[i] = representative(value);
    state.errors[i] = distance_bound(state.y[i], value);
  };
  for (std::size_t j = 0; j < reduction.kept.size(); ++j) set(reduction.kept[j], x[j]);
  Box rates(reduction.ignored.size());
  TapeEvaluator<Interval>(problem.forces->ignored_rates, constants)(x, rates);
  for (std::size_t k = 0; k < rates.size(); ++k) set(n + reduction.ignored[k], rates[k]);
  return state;
}

SteadyState SteadyStates::at(const FoundPlace& found) {
  BoundedState at = bounded_state(problem_, problem_.constants, y_, found.x);
  std::vector<double> place;
  for (const Interval& xi : found.x) place.push_back(representative(xi));
  if (!found.simple && !found.at_kink) {
    place = least_residual(found.x, place);
    const std::vector<std::size_t>& kept = problem_.statics->reduction.kept;
    for (std::size_t j = 0; j < place.size(); ++j) {
      at.y[kept[j]] = place[j];
      at.errors[kept[j]] = distance_bound(place[j], found.x[j]);
    }
  }
  SteadyState state;
  state.y = std::move(at.y);
  state.errors = std::move(at.errors);
  state.simple = found.simple;
  state.at_kink = found.at_kink;
  state.at_cone = found.at_cone;
  state.sides = found.sides;
  state.enclosure = found.x;
  if (!found.at_kink) state.residual = largest_force(place, &Interval::magnitude);
  return state;
}

bool SteadyStates::is_at_rest(const Box& x) {
  Box g(problem_.forces->rest.size());
  forces_(x, g);
  return std::ranges::all_of(g, is_zero);
}

template <class Size>
double SteadyStates::largest_force(const std::vector<double>& place, Size size) {
  std::vector<Interval> g(problem_.forces->rest.size());
  forces_(Box(place.begin(), place.end()), g);
  double largest = 0;
  for (const Interval& force : g) largest = std::max(largest, std::abs(std::invoke(size, force)));
  return largest;
}

/// Of many zeros too close to be told apart, or none: where the forces are least.
std::vector<double> SteadyStates::least_residual(const Box& x, std::vector<double> best) {
  double least = largest_force(best, &Interval::middle);
  constexpr int samples = 64;
  for (std::size_t j = 0; j < x.size(); ++j) {
    const std::vector<double> start = best;
    for (int i = 0; i <= samples; ++i) {
      std::vector<double> place = start;
      place[j] = x[j].lower + x[j].width() * i / samples;
      if (const double here = largest_force(place, &Interval::middle); here < least) {
        least = here;
        best = place;
      }
    }
  }
  return best;
}

}  // namespace qdot
