#pragma once
// The eigenvalue problems of M u'' + D u' + K u = 0 in ball arithmetic.

#include <vector>

#include "core/numerics/eigensystem.hpp"

namespace qdot {

/// Of the coordinates that are not ignored.
struct SmallMotions {
  SquareMatrix<Ball> mass, stiffness, rates;  ///< M, K and D

  [[nodiscard]] std::size_t size() const { return mass.size(); }
  /// D = 0, exactly.
  [[nodiscard]] bool depends_on_squares() const;
  /// M and K symmetric and D skew: s is an eigenvalue with -s.
  [[nodiscard]] bool undamped() const;
};

/// lambda of K v = lambda M v, where all lambda are real: vectors empty (size 0) where they are not.
/// Throws Error(not_applicable) where M has no inverse.
[[nodiscard]] Eigensystem<Ball> squares(const SmallMotions& motions);

/// A x = s B x for x = (u, u'):  A = (0 1; -K -D),  B = (1 0; 0 M),  2n x 2n.
struct StatePencil {
  SquareMatrix<ComplexBall> a, b;
};
[[nodiscard]] StatePencil state_pencil(const SmallMotions& motions);

/// s of (s^2 M + s D + K) v = 0: 2n values; the first n components of a vector are v.
[[nodiscard]] Eigensystem<ComplexBall> exponents(const SmallMotions& motions);

/// A basis of the v with K v = 0, in columns, as many as the rank of K leaves.
[[nodiscard]] std::vector<std::vector<ComplexBall>> kernel(const SquareMatrix<Ball>& k);
[[nodiscard]] std::vector<std::vector<ComplexBall>> kernel(const SquareMatrix<ComplexBall>& k);

/// Combinations of `vectors` in reduced echelon form: each has a component 1 where those before it have none
/// and all others have 0.
[[nodiscard]] std::vector<std::vector<ComplexBall>> echelon_form(
    std::vector<std::vector<ComplexBall>> vectors);

}  // namespace qdot
