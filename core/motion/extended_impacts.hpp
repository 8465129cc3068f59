#pragma once
// A motion with impacts in double-doubles, along the impacts of a motion in doubles: these are known to its
// error, a billionth of a second, say. Each is the zero of the scene's event next to the one that is known,
//
//   g(y(t_k + d)) = 0,   y(t_k + d) = sum_j c_j d^j,
//
// found by the secant method, so that the series needs few terms. What is measured so is what rounding did to
// the motion; whether another impact comes before is the other computations' to tell.

#include <optional>
#include <span>

#include "core/motion/extended_motion.hpp"
#include "core/motion/simulation.hpp"

namespace qdot {

/// The states on the grid. None where an impact is not found next to the one that is known, where a row lies
/// between the two, so that it may belong to either side, where several impacts are of one instant, or where
/// an event of the scene or its map contains accelerations.
[[nodiscard]] std::optional<ExtendedRun> extended_states_through(std::span<const SectionRecord> sections,
                                                                 const Dynamics& dynamics,
                                                                 const ExtendedMotionRequest& request);

}  // namespace qdot
