#pragma once
// Places that a search found, each once: a place may be found at both ends of a turn, and beside a kink as
// well as at it.

#include <vector>

#include "core/numerics/root_isolation.hpp"

namespace qdot {

struct FoundPlace {
  Box x{};      ///< encloses it; all kept coordinates
  Box alone{};  ///< holds no other on the same side of all kinks; only where simple
  Box sides{};  ///< of each kink: -1 or 1, or an enclosure where the place is at it
  bool simple{};
  bool at_kink{};
  bool at_cone{};  ///< a kink of another kind (core/steady/cones.hpp)

  /// Coordinate j less or more by a full turn, so that it lies in (-pi, pi].
  void turn_back(std::size_t j);
};

class FoundPlaces {
 public:
  /// Joins what is known to be the same place. What overlaps without being known to be the same becomes one
  /// place that is not simple; a cluster beside a simple place stays a place of its own.
  void add(FoundPlace place);
  [[nodiscard]] const std::vector<FoundPlace>& places() const { return places_; }

 private:
  std::vector<FoundPlace> places_;
};

}  // namespace qdot
