#pragma once
// The statics of a scene whose coordinates obey holonomic constraints phi(q) = 0. At rest on their surface
//
//   g_i(q) = sum_j lambda_j A_ji,   A_ji = dphi_j/dq_i,   phi_j(q) = 0,
//
// which is what the Lagrangian L + sum of lambda_j phi_j says at rest with the multipliers as coordinates
// without mass. They are taken as those of a scene with n + m coordinates (q, lambda). Source: Nocedal,
// Wright, Numerical Optimization, 2nd ed., 12.3.

#include <memory>
#include <string>
#include <vector>

#include "core/dynamics/dynamics.hpp"

namespace qdot {

struct SurfaceStatics {
  std::size_t coordinates{}, constraints{};  ///< n and m
  std::unique_ptr<const Dynamics> dynamics;  ///< of (q, lambda)
  std::shared_ptr<const Statics> statics;    ///< of `dynamics`; no coordinate is ignored
};

/// Throws Error(not_applicable) where a constraint is not holonomic or moves, where coordinates are
/// ignorable, with inputs, and with kinks in the forces.
[[nodiscard]] SurfaceStatics surface_statics(const Dynamics& dynamics, const Reals& parameters);

/// Throws Error(not_applicable): "This is undetermined for a scene with constraints: " and why.
[[noreturn]] void undetermined_on_surface(const std::string& why);

/// (q, lambda) where the system would be let go at q: the multipliers that hold it there.
[[nodiscard]] std::vector<double> with_multipliers(const Dynamics& dynamics, const Reals& parameters,
                                                   std::vector<double> q);

}  // namespace qdot
