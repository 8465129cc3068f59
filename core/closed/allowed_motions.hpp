#pragma once
// Small motions that constraints allow about a place where the system rests, by the parameters.
//
//   g_i(q) = sum_j lambda_j A_ji,  phi_j(q) = 0      the place, x = (q, lambda)
//   K_ik = d(g_i - sum_j lambda_j A_ji)/dq_k         lambda held
//   u = Z v,  A Z = 0                                Z^T M Z v'' + Z^T D Z v' + Z^T K Z v = 0
//
// Constraints in the velocities have no phi; at rest they allow the same displacements. See
// core/steady/constrained_modes.hpp, which computes with numbers what this does with formulas.

#include <optional>

#include "core/closed/linear_motions.hpp"

namespace qdot {

/// The motions of all coordinates q, ignorable ones included, the multipliers among x. None where a force
/// depends on a multiplier or a constraint moves.
[[nodiscard]] std::optional<LinearMotions> motions_with_multipliers(const Model& model,
                                                                    const Reals& parameters);

/// At the place, of the coordinates that are left free; the others follow. Throws Error(not_applicable)
/// where constraints depend on each other.
[[nodiscard]] std::optional<LinearMotions> allowed_motions(const LinearMotions& motions,
                                                           const ExactPlace& place,
                                                           const ExactValues& values);

}  // namespace qdot
