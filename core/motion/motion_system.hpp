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

/// On the sides of the kinks; not for methods of fixed step. `parameters`: those of KinkModes.
[[nodiscard]] RightHandSide motion_system(const Dynamics& dynamics, const Sides& sides,
                                          std::span<const double> parameters, Method method);

/// The motions that a request stands for, which differ by their parameters; on the sides of kinks where there
/// are `sides`.
[[nodiscard]] Originals motions_stood_for(const Dynamics& dynamics, const Sides* sides,
                                          std::span<const double> asked, std::span<const double> rounded,
                                          Method method);

}  // namespace qdot
