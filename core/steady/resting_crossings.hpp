#pragma once
// Equilibria that stay in their place x0 for every p, 0 or half a turn, g(x0, p) = 0: where det g_x(x0, p)
// has a simple zero, exactly one other curve of equilibria crosses. With g_x v = 0 and u g_x = 0 there it is
//   transcritical   u g_xx[v, v] != 0
//   pitchfork       u g_xx[v, v] = 0 for a reflection that turns v into -v, and
//                   u (g_xxx[v, v, v] + 6 g_xx[v, w]) != 0,  g_x w = -g_xx[v, v]/2
// These are proven without a search for equilibria elsewhere.
// Source: Crandall, Rabinowitz, J. Funct. Anal. 8 (1971), theorem 1.7; Golubitsky, Schaeffer, Singularities
// and Groups in Bifurcation Theory I (1985), I.3.

#include <vector>

#include "core/mechanics/scene.hpp"
#include "core/steady/critical_kinds.hpp"

namespace qdot {

/// Of two to four unknowns; `place`: which of the reduction's constants p is, with p in `range`. Places where
/// p is one of the values `degenerate` are left out.
[[nodiscard]] std::vector<KnownZero> resting_crossings(const Scene& scene, const SteadyProblem& problem,
                                                       const BifurcationSystems& systems, std::size_t place,
                                                       const Interval& range,
                                                       std::span<const double> degenerate);

/// Puts crossings among what a search has found: they are better known than what is unresolved there.
void take_crossings(std::vector<KnownZero>& found, std::vector<KnownZero> crossings);

}  // namespace qdot
