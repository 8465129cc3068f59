#pragma once
// Places that forces prove to be the numbers that are meant, instead of enclosures of them: 0, a half, pi; or
// where a coordinate is at a kink.

#include "core/steady/bounded_state.hpp"
#include "core/steady/force_system.hpp"

namespace qdot {

class ExactPlaces {
 public:
  /// All must outlive it.
  ExactPlaces(const SteadyForces& forces, ForceSystem& system, SteadyStates& states)
      : forces_(forces), system_(system), states_(states) {}

  /// The number that is meant, where the forces prove that it is the zero.
  void make_exact(FoundPlace& place);

 private:
  struct Unknowns {
    Sides sides;
    Box values;  ///< those of the place, then the sides on which it is not
  };
  [[nodiscard]] Unknowns unknowns_of(const FoundPlace& place) const;
  [[nodiscard]] bool rests_at(const FoundPlace& place);
  void put_on_kinks(FoundPlace& place);

  const SteadyForces& forces_;
  ForceSystem& system_;
  SteadyStates& states_;
};

}  // namespace qdot
