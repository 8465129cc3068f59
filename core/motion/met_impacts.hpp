#pragma once
// What a section of a motion has met of events, conditions and impacts where it ended, and how the motion
// goes on after the impacts.

#include "core/integrate/run.hpp"
#include "core/motion/impacts_along.hpp"
#include "core/motion/running_motion.hpp"

namespace qdot {

class MetImpacts {
 public:
  /// Keeps the reference.
  explicit MetImpacts(RunningMotion& motion);

  /// Records the events of the section, and the condition that ends the motion. True where an impact ended
  /// it.
  bool record_events(const Run& done);
  /// Goes on from the state after the impacts of this instant; false when the motion is over there anyway.
  bool pass();

 private:
  [[nodiscard]] InstantImpacts::Passed pass_instant();
  void doubt_order();
  void doubt_events_beside(const SectionRecord& impact);
  [[nodiscard]] bool ends_in_instant(const SectionRecord& impact);
  [[nodiscard]] bool is_over(const InstantImpacts::Passed& passed);
  [[nodiscard]] SectionEnd ending(const InstantImpacts::Passed& passed) const;
  void doubt_instant(const SectionEnd& end, const InstantImpacts::Passed& passed, double late);

  RunningMotion& motion_;
  ImpactsAlong impacts_;
  const Watch* ended_by_{};  ///< in this instant
};

}  // namespace qdot
