#pragma once
// The statics of a scene whose coordinates obey holonomic constraints phi(q) = 0. At rest on their surface
//
//   g_i(q) = sum_j lambda_j A_ji,   A_ji = dphi_j/dq_i,   phi_j(q) = 0,
//
// which is what the Lagrangian L + sum of lambda_j phi_j says at rest with the multipliers as coordinates
// without mass. They are taken as those of a scene with n + m coordinates (q, lambda). Coordinates that
// neither the Lagrangian nor a constraint contains are ignorable: they keep their momenta, and q are the
// others. Source: Nocedal, Wright, Numerical Optimization, 2nd ed., 12.3.
// Constraints in the velocities, w(q, q') = 0 with A_ji = dw_j/dq_i', hold at rest wherever that is, and say
// no more than which forces balance a place that is given.

#include <memory>
#include <string>
#include <vector>

#include "core/dynamics/dynamics.hpp"
#include "core/numerics/ball.hpp"

namespace qdot {

struct SurfaceStatics {
  std::size_t coordinates{}, constraints{};  ///< n and m
  std::unique_ptr<const Dynamics> dynamics;  ///< of the scene's coordinates, then lambda
  std::shared_ptr<const Statics> statics;    ///< of `dynamics`, with x = (q, lambda)
};

/// Whether the places where the system rests are looked for, or one is given.
enum class RestingPlace { looked_for, given };

/// Throws Error(not_applicable) where a constraint moves, or is not holonomic while places are looked for,
/// with inputs, and with kinks in the forces.
[[nodiscard]] SurfaceStatics surface_statics(const Dynamics& dynamics, const Reals& parameters,
                                             RestingPlace place = RestingPlace::looked_for);

/// Throws Error(not_applicable): "This is undetermined for a scene with constraints: " and why.
[[noreturn]] void undetermined_on_surface(const std::string& why);

/// The scene's coordinates, then the multipliers that the motion has in the state y = (q, q').
[[nodiscard]] std::vector<double> with_multipliers(const Dynamics& dynamics, const Reals& parameters,
                                                   const std::vector<double>& y);

/// The parameters, then the momenta of the ignored coordinates in the state y.
[[nodiscard]] std::vector<Ball> constants_on_surface(const SurfaceStatics& whole, const Dynamics& dynamics,
                                                     const Reals& parameters, const Reals& y);

}  // namespace qdot
