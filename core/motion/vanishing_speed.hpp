#pragma once
// Where a motion ends because a force divides by a speed that comes to 0: friction -mu m g v/|v| of a puck
// that comes to rest. No computation passes such a place, and what it met is no growth beyond bounds.

#include <span>
#include <string>

#include "core/dynamics/dynamics.hpp"
#include "core/motion/simulation_result.hpp"

namespace qdot {

/// A sentence on what came to rest where the motion from `start` failed; empty where no speed vanished that
/// a force divides by.
[[nodiscard]] std::string speed_that_vanished(const Dynamics& dynamics, const Reals& parameters,
                                              std::span<const double> start, const Simulation& failed);

}  // namespace qdot
