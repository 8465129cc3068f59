#pragma once
// Conditions of validity that an impact leaves as near to zero as its errors: whether the motion ends with
// the impact is for those to tell, as where it nearly meets a condition on its way
// (core/integrate/approaches.hpp).

#include <vector>

#include "core/motion/motion_sections.hpp"
#include "core/motion/section_record.hpp"

namespace qdot {

/// At the beginning of the section after that impact, of conditions that are far smaller than before it.
[[nodiscard]] std::vector<Approach> conditions_near_zero(const MotionSections& sections,
                                                         const SectionRecord& impact);

}  // namespace qdot
