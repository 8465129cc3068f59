#pragma once
// Equations linearized about a steady motion, M u'' + D u' + K u = 0, and what single displacements do there.

#include <vector>

#include "core/steady/equilibrium.hpp"
#include "core/steady/small_motions.hpp"
#include "core/steady/solved_slopes.hpp"

namespace qdot {

/// Those of the kept coordinates, and those of all N coordinates along it, which are the same where none is
/// ignored.
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

/// The displacement v of a mode.
using Shape = std::vector<ComplexBall>;

/// `function` of the constants at x, in balls.
[[nodiscard]] std::vector<Ball> evaluated(const CompiledFunction& function,
                                          const std::vector<Ball>& constants, const std::vector<Ball>& x);

/// Those of the place's family, as displacements v.
[[nodiscard]] std::vector<Shape> directions_of_family(const Linearization& at);
/// u of the kept coordinates.
[[nodiscard]] Shape displaced(const Linearization& at, const Shape& v);
/// How far lambda of K v = lambda M v moves when every parameter moves by half a unit in its last place.
[[nodiscard]] double rounding_of_parameters(const Linearization& at, const Shape& v);

/// So many of these v with K v = 0, or of their combinations, have D v = 0 as well: u = v t is a motion, too,
/// and s = 0 counts twice.
[[nodiscard]] std::size_t undamped_among(const SmallMotions& motions, const std::vector<Shape>& shapes);
/// Whether M is positive or negative definite: only beside such a kinetic energy does a potential decide.
[[nodiscard]] bool has_one_sign(const SquareMatrix<Ball>& mass);
/// M and K are positive definite, or both negative: without damping nothing can grow.
[[nodiscard]] bool held_by_potential(const SmallMotions& motions);
/// s^2 M + s D + K.
[[nodiscard]] SquareMatrix<ComplexBall> dynamic_stiffness(const SmallMotions& motions, const ComplexBall& s);

}  // namespace qdot
