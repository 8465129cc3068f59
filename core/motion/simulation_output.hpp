#pragma once
// What is computed from the rows of a motion that is over: columns, and how well it has kept what it keeps.

#include <span>

#include "core/motion/motion_sections.hpp"
#include "core/motion/simulation_result.hpp"

namespace qdot {

/// `row_sections`: the section of each row. Throws Error(invalid_state) where one has no finite value.
void fill_columns(const SimulationRequest& request, MotionSections& sections,
                  std::span<const std::size_t> row_sections, Simulation& motion);

/// How well a reference keeps it some rows tell, of which the last is one.
void note_what_is_kept(const Dynamics& dynamics, const SimulationRequest& request,
                       std::span<const Segment> segments, Simulation& motion);

}  // namespace qdot
