#pragma once
// One equilibrium, or steady motion, near a guess: a zero of the forces g(x) = E(x, 0, 0), x being the
// coordinates that are not ignorable.
//
// It is found by Newton's iteration with K = dg/dx, damped so that each step shortens the next (Deuflhard,
// Newton Methods for Nonlinear Problems, 2004, 3.3), and then proven (core/steady/equilibrium_enclosure.hpp).
// Coordinates that no force depends on stay where the guess has them.

#include <span>

#include "core/dynamics/dynamics.hpp"
#include "core/steady/equilibrium_enclosure.hpp"

namespace qdot {

enum class EquilibriumSearch {
  nearest,  ///< Newton's iteration from the guess, whatever the stability there
  stable    ///< down the effective potential from the guess; `nearest` where that leads to none that is valid
};

/// `constants` are the reduction's: the parameters, then the momenta. Throws Error(not_applicable) with a
/// sentence where there is none near the guess.
[[nodiscard]] Equilibrium find_equilibrium(const Dynamics& dynamics, const Statics& statics,
                                           std::span<const Ball> constants, std::span<const double> guess,
                                           EquilibriumSearch search);

}  // namespace qdot
