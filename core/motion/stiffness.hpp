#pragma once
// Where damping, not accuracy, would rule the step of an explicit method.
//
// With an eigenvalue -r of the Jacobian far in the negative half plane, explicit methods, Taylor's among
// them, take steps of about 10/r although the motion that is left changes slowly. Undamped systems have
// their eigenvalues in pairs +-s: a negative one without a positive partner is damping. Source: Hairer,
// Wanner, Solving Ordinary Differential Equations II, 2nd ed., IV.1.

#include <span>

#include "core/dynamics/dynamics.hpp"

namespace qdot {

/// r times the span, as the state shows it; 0 where it is not by far the fastest rate there.
[[nodiscard]] double damping_times_span(const Dynamics& dynamics, std::span<const double> parameters,
                                        double t, std::span<const double> y, double span);

}  // namespace qdot
