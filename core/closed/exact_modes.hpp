#pragma once
// Frequencies and shapes of small motions as formulas, where the equilibrium has one and the coordinates fall
// apart into groups of one or two that K v = lambda M v couples: lambda = K/M, or a root of
//
//   (M11 M22 - M12 M21) lambda^2 - (M11 K22 + M22 K11 - M12 K21 - M21 K12) lambda + K11 K22 - K12 K21 = 0.
//
// Without damping (Goldstein, Classical Mechanics, 3rd ed., 6.2); of one coordinate with it
// (damped_mode.hpp). Every formula is held against the enclosed number, and the equations themselves at other
// values of the parameters.

#include "core/closed/exact_mode.hpp"
#include "core/dynamics/dynamics.hpp"
#include "core/steady/modes.hpp"

namespace qdot {

struct ExactModes {
  std::vector<std::optional<ExactMode>> modes;   ///< of Modes::modes, in order
  std::vector<std::optional<ClosedForm>> state;  ///< of the coordinates at the equilibrium
};

/// Of modes that were found for these parameters.
[[nodiscard]] ExactModes exact_modes(const Dynamics& dynamics, const Reals& parameters,
                                     const WrittenTexts& written, const Modes& found);

}  // namespace qdot
