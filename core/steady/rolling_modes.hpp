#pragma once
// Modes of a steady motion under constraints in the velocities, such as rolling (steady_rolling.hpp).
//
//   u = Z_h p,  u' = Z v + Y u,  A Z = 0,  A Y = -B,  A_h Z_h = 0
//   p' = (u')_F,  Z^T M Z v' = -Z^T ((M Y + D) u' + K u)
//
// where F are the displacements that holonomic constraints leave free. These are of first order in (p, v),
// and s are the eigenvalues of their matrix: 2n minus one for every constraint, minus one more for each that
// is holonomic. A body that rolls can rest or spin in many places, so that some s are 0, which say nothing of
// small motions; and s need not come with -s: what grows in a spin decays in the opposite one.

#include <optional>
#include <vector>

#include "core/steady/modes.hpp"

namespace qdot {

/// About the equilibrium at `guess` (q), or in `initial` (q, q'), or the steady motion with the rates that
/// `initial` has. Throws what steady_rolling throws, and Error(not_applicable) where no bound of the
/// eigenvalues could be proven.
[[nodiscard]] Modes rolling_modes(const Dynamics& dynamics, const Reals& parameters, const Reals& initial,
                                  const std::optional<std::vector<double>>& guess = std::nullopt);

}  // namespace qdot
