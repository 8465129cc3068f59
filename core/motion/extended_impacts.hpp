#pragma once
// A motion with impacts in double-doubles, along the impacts of a motion in doubles: each is the zero of the
// scene's event next to the one that is known (extended_pieces.hpp).

#include <optional>
#include <span>

#include "core/motion/extended_motion.hpp"
#include "core/motion/simulation.hpp"

namespace qdot {

/// The states on the grid. None where an impact is not found next to the one that is known, where a row lies
/// between the two, so that it may belong to either side, or where several impacts are of one instant.
[[nodiscard]] std::optional<ExtendedRun> extended_states_through(std::span<const SectionRecord> sections,
                                                                 const Dynamics& dynamics,
                                                                 const ExtendedMotionRequest& request);

}  // namespace qdot
