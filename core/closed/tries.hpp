#pragma once
// What a formula says at places that are tried, and near which of them more are worth trying: a condition
// that one place in a hundred breaks is found where it nearly breaks.

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "core/closed/exact_values.hpp"

namespace qdot {

/// Values of all symbols that a formula may speak of.
using FarPlace = std::vector<RealAssignment>;

/// With the rounding of doubles.
[[nodiscard]] inline double rough_value(const Expression& e, const FarPlace& place) {
  std::vector<Assignment> doubles;
  doubles.reserve(place.size());
  for (const auto& [symbol, value] : place) doubles.emplace_back(symbol, value.value);
  return evaluate(e, doubles);
}

/// Whether a formula holds somewhere, and by several measures how much is left until it does not.
struct Claim {
  bool holds{};
  std::vector<double> rooms{};
  bool is_real{true};  ///< the formula has a value there
};
/// None where it claims nothing.
using Tried = std::function<std::optional<Claim>(const FarPlace&)>;

/// What a formula says at places, and how much room it has there.
class Tries {
 public:
  explicit Tries(const Tried& tried) : tried_(tried) {}

  /// Whether anything is claimed there. Where the place is made of another, that one is kept for the search.
  bool add(const FarPlace& place, const FarPlace& made_of) {
    const auto verdict = tried_(place);
    if (!verdict) return false;
    holds.push_back(verdict->holds);
    is_real.push_back(verdict->is_real);
    places.push_back(place);
    if (!verdict->holds) return true;
    scarce_.resize(std::max(scarce_.size(), verdict->rooms.size()));
    for (std::size_t k = 0; k < verdict->rooms.size(); ++k)
      scarce_[k].emplace_back(verdict->rooms[k], made_of);
    return true;
  }

  /// Whether it tells by how much claims hold.
  [[nodiscard]] bool has_rooms() const { return !scarce_.empty(); }

  /// So many with the least room, by each measure.
  [[nodiscard]] std::vector<FarPlace> scarce(std::size_t most) {
    std::vector<FarPlace> found;
    for (auto& places_by_room : scarce_) {
      std::ranges::stable_sort(places_by_room, {}, [](const auto& s) { return s.first; });
      if (places_by_room.size() > most) places_by_room.resize(most);
      for (const auto& [room, place] : places_by_room) found.push_back(place);
    }
    return found;
  }

  std::vector<FarPlace> places;
  std::vector<bool> holds, is_real;
  std::vector<std::vector<bool>> broken;  ///< of each condition, at the places that were looked at until now

 private:
  const Tried& tried_;
  std::vector<std::vector<std::pair<double, FarPlace>>> scarce_;
};

}  // namespace qdot
