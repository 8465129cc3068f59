#pragma once
// Small motions that obey holonomic constraints phi(q) = 0, about an equilibrium on their surface.
//
//   g_i(q) = sum_j lambda_j A_ji,  phi_j(q) = 0        the equilibrium, q and lambda at once
//   K_ik = d(g_i - sum_j lambda_j A_ji)/dq_k           lambda held: the surface's curvature counts
//   u = Z v,  A Z = 0                                  displacements that the constraints allow
//   Z^T K Z v = omega^2 Z^T M Z v
//
// The first line is that of the Lagrangian L + sum of lambda phi with the multipliers as coordinates without
// mass, whose statics are taken as those of any other. All of it is enclosed as in modes.hpp. Source:
// Nocedal, Wright, Numerical Optimization, 2nd ed., 12.5 and 16.1 (the projected Hessian).

#include "core/steady/modes.hpp"

namespace qdot {

/// As normal_modes, of a model with constraints; but always the equilibrium that Newton's iteration finds
/// from the guess, whatever its stability. Mass and stiffness are M and K above. Throws Error(not_applicable)
/// where a constraint is not holonomic or moves, where coordinates are ignorable, and with damping or
/// gyroscopic terms.
[[nodiscard]] Modes constrained_modes(const Dynamics& dynamics, const Reals& parameters, const Reals& initial,
                                      const std::optional<std::vector<double>>& guess = std::nullopt);

}  // namespace qdot
