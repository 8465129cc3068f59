#pragma once
// A motion with kinks in double-doubles, along the pieces of a motion in doubles: each is smooth, and ends at
// the zero of its kink's function next to the instant that is known (extended_pieces.hpp).

#include <span>

#include "core/motion/extended_motion.hpp"
#include "core/motion/simulation.hpp"

namespace qdot {

/// The states on the grid, up to where the end of a piece is not found next to the one that is known, or
/// where several kinks end it: not beyond turns that accumulate.
[[nodiscard]] ExtendedRun extended_states_along(std::span<const PieceRecord> pieces, const Dynamics& dynamics,
                                                const ExtendedMotionRequest& request);

}  // namespace qdot
