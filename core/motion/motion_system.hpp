#pragma once
// The right-hand side of a motion's equations for the methods of core/integrate, y' = (q', q'') for
// y = (q, q'), with what the method of the request needs: a Jacobian, an expansion, canonical variables.

#include <span>

#include "core/integrate/run.hpp"
#include "core/motion/kink_modes.hpp"
#include "core/motion/simulation_request.hpp"

namespace qdot {

/// The equations as they are; kinks count as functions like others.
[[nodiscard]] RightHandSide motion_system(const Dynamics& dynamics, const SimulationRequest& request);

/// The same without canonical variables.
[[nodiscard]] RightHandSide motion_system(const Dynamics& dynamics, std::span<const double> parameters,
                                          Method method);

/// On the sides of the kinks; not for methods of fixed step. `parameters`: those of KinkModes.
[[nodiscard]] RightHandSide motion_system(const Dynamics& dynamics, const Sides& sides,
                                          std::span<const double> parameters, Method method);

}  // namespace qdot
