#pragma once
// A motion while it is computed: how far it has come, in which section it is, and what is carried along from
// one section to the next.

#include <span>

#include "core/dynamics/dynamics.hpp"
#include "core/dynamics/watch.hpp"
#include "core/integrate/run.hpp"
#include "core/motion/apart_along.hpp"
#include "core/motion/event_sides.hpp"
#include "core/motion/motion_sections.hpp"
#include "core/motion/section_end.hpp"
#include "core/motion/simulation_request.hpp"
#include "core/motion/simulation_result.hpp"
#include "core/motion/unseen_along.hpp"

namespace qdot {

struct RunningMotion {
  /// At its start. Keeps the references.
  RunningMotion(const Dynamics& dynamics, const SimulationRequest& request);
  RunningMotion(const RunningMotion&) = delete;
  RunningMotion& operator=(const RunningMotion&) = delete;

  const Dynamics& dynamics;
  const SimulationRequest& request;
  MotionSections sections;
  ApartAlong apart;
  EventSides sides;
  UnseenAlong unseen;
  Simulation result;  ///< so far; the motion is at its t and y
  bool is_determined{true};

  /// All computations may be off by that from here on, beside a kink whose side is not known.
  void doubt_kinks(std::span<const double> off);
  /// From here on there are more ways than two orders.
  void note_unclear();
  /// Throws Error(too_large) when there are more than one answer holds.
  void record_event(EventRecord event);
  /// The motion ends here by that condition.
  void stop_by(const Watch& watch);

  /// The section ends here, where g is zero: what is known of it before the next one has begun.
  [[nodiscard]] SectionEnd ending_by(decltype(EventFunction::value) g) const;
  /// And what is known then.
  void complete(SectionEnd& end) const;
};

}  // namespace qdot
