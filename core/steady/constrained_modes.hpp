#pragma once
// Small motions that obey holonomic constraints phi(q) = 0, about an equilibrium on their surface.
//
//   g_i(q) = sum_j lambda_j A_ji,  phi_j(q) = 0        the equilibrium, q and lambda at once
//   K_ik = d(g_i - sum_j lambda_j A_ji)/dq_k           lambda held: the surface's curvature counts
//   u = Z v,  A Z = 0                                  displacements that the constraints allow
//   Z^T K Z v = omega^2 Z^T M Z v
//
// All of it is enclosed as in modes.hpp. Source: Nocedal, Wright, Numerical Optimization, 2nd ed., 12.5
// and 16.1 (the projected Hessian).

#include "core/steady/modes.hpp"
#include "core/steady/surface_statics.hpp"

namespace qdot {

struct SurfaceModes {
  Modes modes;
  Equilibrium place;  ///< (q, lambda)
};

/// About the equilibrium that Newton's iteration finds from `guess` (q, lambda), whatever its stability.
/// Throws Error(not_applicable) where there is none near, and with forces that have no potential or depend on
/// velocities.
[[nodiscard]] SurfaceModes surface_modes(const SurfaceStatics& whole, const Reals& parameters,
                                         const std::vector<double>& guess);

/// The same about the one equilibrium that is known to be within `q`, whose multipliers follow from it.
[[nodiscard]] SurfaceModes surface_modes_at(const SurfaceStatics& whole, const Reals& parameters,
                                            std::span<const Interval> q);

/// As normal_modes, of a model with constraints; but always the equilibrium that Newton's iteration finds
/// from the guess, whatever its stability. Mass and stiffness are M and K above. Throws what surface_statics
/// and surface_modes throw. With constraints in the velocities those of rolling_modes.hpp.
[[nodiscard]] Modes constrained_modes(const Dynamics& dynamics, const Reals& parameters, const Reals& initial,
                                      const std::optional<std::vector<double>>& guess = std::nullopt);

}  // namespace qdot
