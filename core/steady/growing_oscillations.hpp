#pragma once
// Where small motions M u'' + D u' + K u = 0 begin to grow in oscillations as a parameter moves: a pair
// s = +-i omega of roots of
//
//   P(s) = det(s^2 M + s D + K) = a_0 s^N + a_1 s^(N-1) + ... + a_N
//
// crosses the imaginary axis (Hopf), where the Hurwitz determinant H_(N-1) = det (a_(2i-j)) vanishes, which
// is, up to a power of a_0, the product of all sums of two roots (Orlando's formula). It vanishes for roots
// +-r, too, where omega^2 = -r^2 < 0. Where P is even, as without damping, no root crosses alone: two pairs
// meet on the axis and leave it, where the discriminant of P as a polynomial of s^2 vanishes (flutter of
// follower forces; gyroscopic stabilization lost). Sources: Gantmacher, The Theory of Matrices II, XV.7;
// Merkin, Introduction to the Theory of Stability (1997), 6.5 and 6.6; Ziegler, Principles of Structural
// Stability, 2nd ed., 4.

#include <optional>

#include "core/expr/linear.hpp"

namespace qdot {

struct GrowingOscillations {
  Expression condition;              ///< what vanishes there, not simplified
  std::optional<Expression> square;  ///< omega^2 there; none for N > 4
  bool is_collision{};               ///< of two pairs
};

/// None where it never happens whatever the parameters: D = 0 and K symmetric; and for more than
/// largest_written_system coordinates.
[[nodiscard]] std::optional<GrowingOscillations> growing_oscillations(const Matrix& mass, const Matrix& rates,
                                                                      const Matrix& stiffness);

}  // namespace qdot
