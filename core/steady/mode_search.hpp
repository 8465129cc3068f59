#pragma once
// The modes of M u'' + D u' + K u = 0 about one place,
// with bounds (core/steady/modes.hpp has the equations).

#include <vector>

#include "core/steady/equilibrium.hpp"
#include "core/steady/mode.hpp"
#include "core/steady/small_motions.hpp"
#include "core/steady/solved_slopes.hpp"

namespace qdot {

/// Equations linearized about a steady motion: those of the kept coordinates, and those of all N coordinates
/// along it, which are the same where none is ignored.
struct Linearization {
  const Statics& statics;
  const std::vector<Ball>& constants;
  const Equilibrium& place;
  std::size_t coordinates{};  ///< N
  SmallMotions reduced, whole;
  /// Z, where the kept coordinates u = Z v move with fewer v on a surface, to which `reduced` belongs; the
  /// multipliers come after u in the statics' x and stay. Empty: u = v.
  BallMatrix allowed;
};

/// `function` of the constants at x, in balls.
[[nodiscard]] std::vector<Ball> evaluated(const CompiledFunction& function,
                                          const std::vector<Ball>& constants, const std::vector<Ball>& x);

/// All modes by omega, at 0 in the order of ModeKind, their shapes in all N coordinates: one rigid mode for
/// each ignored coordinate, and those of the kept ones.
[[nodiscard]] std::vector<Mode> modes_of(const Linearization& linearization);

}  // namespace qdot
