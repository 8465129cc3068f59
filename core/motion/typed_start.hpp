#pragma once
// Where a motion is at the double next to the instant that its start was typed as, r later than that double:
//
//   y(t_start) = y_start - r f(t_start, y_start).
//
// As r is below the rounding of t_start, its square is nothing beside it.

#include "core/dynamics/dynamics.hpp"
#include "core/motion/sided_motions.hpp"
#include "core/motion/simulation_request.hpp"

namespace qdot {

[[nodiscard]] Reals start_as_typed(const Dynamics& dynamics, const SimulationRequest& request);

/// Where the motion that is asked for begins, to the digits that were typed: of a reference that of the
/// motion which it stands for.
[[nodiscard]] SidedMotions::Typed typed_start(const SimulationRequest& request);

}  // namespace qdot
