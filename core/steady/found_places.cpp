#include "core/steady/found_places.hpp"

#include <algorithm>

#include "core/numerics/box.hpp"
#include "core/steady/search_region.hpp"

namespace qdot {
namespace {

bool holds(const Box& outer, const Box& box) {
  if (outer.size() != box.size()) return false;
  for (std::size_t i = 0; i < box.size(); ++i) {
    if (!outer[i].contains(box[i])) return false;
  }
  return true;
}

bool is_side(const Interval& s) { return s.width() == 0 && s.magnitude() == 1; }

bool same_sides(const FoundPlace& a, const FoundPlace& b) {
  for (std::size_t k = 0; k < a.sides.size(); ++k) {
    const bool beside = is_side(a.sides[k]) || is_side(b.sides[k]);
    if (beside && (a.sides[k].lower != b.sides[k].lower || a.sides[k].upper != b.sides[k].upper))
      return false;
  }
  return true;
}

void join(FoundPlace& place, const FoundPlace& other) {
  for (std::size_t i = 0; i < place.x.size(); ++i) place.x[i] = hull(place.x[i], other.x[i]);
  for (std::size_t k = 0; k < place.sides.size(); ++k) place.sides[k] = hull(place.sides[k], other.sides[k]);
  place.simple = false;
  place.at_kink = place.at_kink || other.at_kink;
  place.alone.clear();
}

}  // namespace

void FoundPlace::turn_back(std::size_t j) {
  const Interval back = reduced_angle(x[j]);
  if (!alone.empty() && back.lower != x[j].lower) {
    // Both ends move by the same number; what rounding adds comes off again.
    constexpr double rounding = 8e-15;
    const double turn = back.middle() - x[j].middle();
    alone[j] = {alone[j].lower + turn + rounding, alone[j].upper + turn - rounding};
  }
  x[j] = back;
}

void FoundPlaces::add(FoundPlace place) {
  for (FoundPlace& known : places_) {
    if (!overlap(known.x, place.x)) continue;
    if (known.simple && place.simple && same_sides(known, place) &&
        (holds(known.alone, place.x) || holds(place.alone, known.x)))
      return;
    const bool apart = known.simple != place.simple && !known.at_kink && !place.at_kink;
    if (apart) continue;
    return join(known, place);
  }
  places_.push_back(std::move(place));
}

}  // namespace qdot
