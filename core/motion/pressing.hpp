#pragma once
// Whether forces press the motion onto the surface g = 0 that an impact has left it on.

#include <vector>

#include "core/dynamics/watch.hpp"
#include "core/motion/motion_sections.hpp"
#include "core/motion/section_record.hpp"

namespace qdot {

/// The acceleration |g''| towards the surface of a falling or rising distance g, the smaller one by the
/// forces of then and of soon; that of soon where nothing presses then; below zero where both lift, 0 where
/// one does, or none is seen within half the motion's `span`.
[[nodiscard]] double pressing(const Watch& watch, const SectionRecord& impact, const MotionSections& sections,
                              double span);

/// What the rate of g after that impact may be by the rounding of velocities: a share of sum_i |dg/dq_i v_i|,
/// of the larger ones before and after it.
[[nodiscard]] double rounding_of_rate(const Watch& watch, const SectionRecord& impact);

}  // namespace qdot
