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
#include "core/steady/kinks.hpp"

namespace qdot {

/// How the place was found.
enum class Arrival {
  newton,         ///< by Newton's iteration from the guess, whatever the stability there
  downhill,       ///< where a motion with strong damping from the guess comes to rest
  seen_downhill,  ///< the same with one coordinate, but that it is the first such place is not proven
};

struct FoundEquilibrium {
  Equilibrium place;
  Arrival arrival{};
};

/// By Newton's iteration. `constants` are the reduction's: the parameters, then the momenta. Throws
/// Error(not_applicable) with a sentence where there is none near the guess.
[[nodiscard]] Equilibrium equilibrium_near(const Dynamics& dynamics, const Statics& statics,
                                           std::span<const Ball> constants, std::span<const double> guess);

/// Down the effective potential from the guess; as above where that leads to none that is valid. With one
/// coordinate the first place where its force vanishes (next_balance.hpp), with several the end of the flow
/// (gradient_flow.hpp). A guess that is at rest is the equilibrium, also where it is unstable.
[[nodiscard]] FoundEquilibrium equilibrium_downhill(const Dynamics& dynamics, const Statics& statics,
                                                    const SmoothForces& smooth,
                                                    std::span<const Ball> constants,
                                                    std::span<const double> guess);

}  // namespace qdot
