#pragma once
// Jumps and steps of reported events (Watch::Kind::jump) that are passed where their event is not met. Beside
// a turn of the motion rounding may hide the jump, or the event's function has the same sign behind it: the
// errors tell which.

#include "core/motion/motion_sections.hpp"
#include "core/motion/simulation_result.hpp"

namespace qdot {

/// Adds those of a run to the approaches of events that are reported only.
void note_passed_jumps(const MotionSections& sections, const Run& done, Simulation& motion);

}  // namespace qdot
