#include "core/steady/exact_places.hpp"

#include <algorithm>

#include "core/steady/search_region.hpp"

namespace qdot {

void ExactPlaces::make_exact(FoundPlace& place) {
  FoundPlace exact = place;
  for (Interval& x : exact.x) x = representative(x);
  const bool rests = forces_.charts.empty() ? rests_at(exact) : states_.is_at_rest(exact.x);
  if (rests) {
    place = exact;
  } else if (forces_.charts.empty()) {
    put_on_kinks(place);
  }
}

ExactPlaces::Unknowns ExactPlaces::unknowns_of(const FoundPlace& place) const {
  Unknowns unknowns;
  for (const std::size_t j : forces_.unknowns) unknowns.values.push_back(place.x[j]);
  for (const Interval& s : place.sides) {
    unknowns.sides.push_back(s.width() == 0 ? static_cast<int>(s.lower) : 0);
    if (unknowns.sides.back() == 0) unknowns.values.push_back(s);
  }
  return unknowns;
}

/// Whether some sides make all forces vanish: as many forces as there are of those may leave it to them.
bool ExactPlaces::rests_at(const FoundPlace& place) {
  const auto [sides, unknowns] = unknowns_of(place);
  const std::size_t width = unknowns.size(), equations = forces_.equations.size();
  const SquareSystem system = system_.at(sides);
  const Box values = values_over(system, unknowns);
  Box jacobian(width * width);
  system.jacobian(unknowns, jacobian);
  std::size_t left_to_sides = 0;
  for (std::size_t i = 0; i < width; ++i) {
    if (is_zero(values[i])) continue;
    const auto by_sides =
        std::span(jacobian).subspan(i * width + forces_.unknowns.size(), width - forces_.unknowns.size());
    if (i >= equations || !values[i].contains(0.0) || std::ranges::all_of(by_sides, is_zero)) return false;
    ++left_to_sides;
  }
  return left_to_sides <= width - equations;
}

/// A coordinate that alone decides about a kink is where that is zero.
void ExactPlaces::put_on_kinks(FoundPlace& place) {
  const auto [sides, unknowns] = unknowns_of(place);
  const std::size_t width = unknowns.size(), equations = forces_.equations.size();
  const SquareSystem system = system_.at(sides);
  Box jacobian(width * width), meant = unknowns;
  system.jacobian(unknowns, jacobian);
  for (Interval& x : meant) x = representative(x);
  const Box values = values_over(system, meant);
  for (std::size_t i = equations; i < width; ++i) {
    const std::span<const Interval> slopes = std::span(jacobian).subspan(i * width, width);
    const auto decides = std::ranges::find_if_not(slopes, is_zero);
    const auto k = static_cast<std::size_t>(decides - slopes.begin());
    const bool is_alone = std::ranges::count_if(slopes, is_zero) + 1 == std::ssize(slopes);
    if (is_alone && k < forces_.unknowns.size() && !decides->contains(0.0) && is_zero(values[i]))
      place.x[forces_.unknowns[k]] = meant[k];
  }
}

}  // namespace qdot
