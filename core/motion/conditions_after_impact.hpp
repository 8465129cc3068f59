#pragma once
// Conditions of validity that an impact leaves as near to zero as its errors: whether the motion ends with
// the impact is for those to tell, as where it nearly meets a condition on its way
// (core/integrate/approaches.hpp).

#include <span>
#include <string>
#include <vector>

#include "core/motion/motion_sections.hpp"
#include "core/motion/simulation_result.hpp"

namespace qdot {

/// After the last impact of a motion: each condition that the impact has made far smaller is added to the
/// approaches. `apart` and `unseen`: of the state there.
void note_conditions(const MotionSections& sections, std::span<const double> apart,
                     std::span<const double> unseen, Simulation& motion);
/// The motion ends by that condition: where it is one of those it was met there, and not nearly so.
void meet_condition(const std::string& name, double t, std::vector<ApproachRecord>& approaches);

}  // namespace qdot
