#pragma once
// A motion: from parameters and an initial state to columns on a grid, events, and how it ended.

#include "core/motion/simulation_request.hpp"
#include "core/motion/simulation_result.hpp"

namespace qdot {

/// Where abs and sign stand in the equations, every zero of their arguments ends a section of the motion that
/// is smooth, and the next one begins on the other side or stays there (kink_modes.hpp); not for gauss, whose
/// step is fixed. Throws Error(invalid_state) when the initial state describes no configuration,
/// and what Dynamics::event throws.
[[nodiscard]] Simulation simulate(const Dynamics& dynamics, const SimulationRequest& request);

}  // namespace qdot
