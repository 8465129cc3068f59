#pragma once
// Flights after an impact that are lower than the distance g is rounded: how long they last.
//
// An impact leaves g a rate u away from the surface, and the forces press back with a = -g'': the flight
// lasts 2u/a. The next impact leaves q u, and all flights together last
//
//   2u/(a (1 - q)),
//
// for ever where q = 1, or where nothing presses. After restitution 0 there is none.

#include "core/dynamics/watch.hpp"
#include "core/motion/event_sides.hpp"
#include "core/motion/motion_sections.hpp"
#include "core/motion/section_record.hpp"

namespace qdot {

class UnseenFlights {
 public:
  /// `span`: of the motion. Keeps the references.
  UnseenFlights(const MotionSections& sections, const EventSides& sides, double span)
      : sections_(sections), sides_(sides), span_(span) {}

  struct Left {
    double rate{};   ///< u
    double ratio{};  ///< q
  };
  /// What a map that is no restitution leaves; no rate where that is the rounding of velocities.
  [[nodiscard]] Left by_map(const Watch& watch, const SectionRecord& impact) const;

  /// Of all flights after that impact; infinite where they do not end.
  [[nodiscard]] double duration(const Watch& watch, const SectionRecord& impact, const Left& left) const;

 private:
  const MotionSections& sections_;
  const EventSides& sides_;
  double span_;
};

}  // namespace qdot
