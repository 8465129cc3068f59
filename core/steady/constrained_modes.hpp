#pragma once
// Small motions that obey holonomic constraints phi(q) = 0, about an equilibrium or a steady motion on their
// surface.
//
//   g_i(q) = sum_j lambda_j A_ji,  phi_j(q) = 0        the place, q and lambda at once
//   K_ik = d(g_i - sum_j lambda_j A_ji)/dq_k           lambda held: the surface's curvature counts
//   u = Z v,  A Z = 0                                  displacements that the constraints allow
//   Z^T M Z v'' + Z^T D Z v' + Z^T K Z v = 0
//
// with M, D and K as in modes.hpp; ignorable coordinates keep their momenta. All of it is enclosed. Source:
// Nocedal, Wright, Numerical Optimization, 2nd ed., 12.5 and 16.1 (the projected Hessian).

#include "core/steady/linear_stability.hpp"
#include "core/steady/surface_statics.hpp"

namespace qdot {

struct SurfaceModes {
  Modes modes;
  SteadyStability stability;
  Equilibrium place;  ///< (q, lambda)
};

/// About the one equilibrium that is known to be within `x` = q, whose multipliers follow from it. `y` (q,
/// q') has the ignorable coordinates; `constants` are parameters and momenta.
[[nodiscard]] SurfaceModes surface_modes_at(const SurfaceStatics& whole, const std::vector<Ball>& constants,
                                            std::span<const Interval> x, const std::vector<double>& y);

/// As normal_modes, of a model with constraints: about the equilibrium downhill of `initial` on their
/// surface; where none is there, or one is guessed, about the one that Newton's iteration finds, whatever its
/// stability. Mass, stiffness and rates are M, K and D above. Throws what surface_statics throws, and
/// Error(not_applicable) where there is no equilibrium near. With constraints in the velocities those of
/// rolling_modes.hpp.
[[nodiscard]] Modes constrained_modes(const Dynamics& dynamics, const Reals& parameters, const Reals& initial,
                                      const std::optional<std::vector<double>>& guess = std::nullopt);

/// Whether the mass matrix of the motions that the constraints allow has an inverse there. Throws
/// Error(not_applicable) where the constraints depend on each other.
[[nodiscard]] bool has_inertia_on_surface(const SurfaceStatics& whole, const std::vector<Ball>& constants,
                                          std::span<const Interval> x, const std::vector<double>& y);

}  // namespace qdot
