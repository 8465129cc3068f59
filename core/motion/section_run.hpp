#pragma once
// One smooth section of a motion: from where the motion has come to the next kink or impact, or by one short
// step away from rest (start_from_rest.hpp).

#include <vector>

#include "core/integrate/run.hpp"
#include "core/motion/apart_along.hpp"
#include "core/motion/event_sides.hpp"
#include "core/motion/motion_sections.hpp"
#include "core/motion/simulation_result.hpp"
#include "core/motion/start_from_rest.hpp"

namespace qdot {

class SectionRun {
 public:
  /// Hidden kinks behind which a section ends: any more are not looked for.
  static constexpr std::size_t most_hidden = 1000;

  /// Keeps the references.
  SectionRun(const Dynamics& dynamics, const SimulationRequest& request, const MotionSections& sections,
             const ApartAlong& apart, const EventSides& sides);

  [[nodiscard]] Run from(const Simulation& so_far) const;

  /// Whether the motion goes on by a step away from a place where a speed is zero, or after one.
  [[nodiscard]] bool leaves_rest(const Run& done) const;

 private:
  [[nodiscard]] RunRequest request_from(const Simulation& so_far) const;
  [[nodiscard]] std::vector<EventFunction> events_from(const Simulation& so_far) const;
  void enclose(const RunRequest& run, Run& done) const;

  const SimulationRequest& request_;
  const MotionSections& sections_;
  const ApartAlong& apart_;
  const EventSides& sides_;
  StartFromRest from_rest_;
};

/// Takes its rows, adds its counts, and says what it came to.
void append(Run& done, Simulation& to);

}  // namespace qdot
