#pragma once
// Integration of y' = f(t, y). Stepping (stepper.hpp, methods.hpp), events (events.hpp) and sampling on the
// grid are three pieces that meet here.

#include "core/integrate/methods.hpp"
#include "core/integrate/run.hpp"

namespace qdot {

/// Integrates from t_start to t_end >= t_start. Rows and steps are the same bits whatever the grid and the
/// non-terminal events, unless max_evaluations runs out. The same call gives the same bits, on any thread.
/// Throws std::invalid_argument for tolerances that are not positive, for bdf without a Jacobian,
/// for taylor without an expansion and for gauss with h <= 0.
[[nodiscard]] Run integrate(const RightHandSide& system, const RunRequest& request);

}  // namespace qdot
