#pragma once
// Eigenvalues of a pencil A x = lambda B x with rigorous error bounds.
//
// Approximate eigenvectors X are improved until W A X and W B X, W = (B X)^-1, are diagonal to twice the
// digits of doubles,
//   X <- X (I + E),  E_ij = (P_ij - lambda_j Q_ij)/(lambda_j - lambda_i),  P = W A X, Q = W B X,
// and then enclosed in ball arithmetic: by Gershgorin's theorem for P - lambda Q, each connected set of discs
// |lambda - P_ii/Q_ii| <= r_i holds as many eigenvalues as discs: a member of a group is known to no better
// than all of the group's discs. Where eigenvectors are nearly parallel nothing is proven this way; see
// core/numerics/eigenvalue_clusters.hpp.
// Sources: Ogita, Aishima, Iterative refinement for symmetric eigenvalue decomposition, JJIAM 35 (2018);
// Stewart, Sun, Matrix Perturbation Theory (1990), VI.2.

#include <vector>

#include "core/numerics/ball_matrix.hpp"

namespace qdot {

template <class T>
struct Eigensystem {
  std::vector<T> values;       ///< middles; what is enclosed lies within `radii`
  std::vector<double> radii;   ///< not finite where nothing could be proved
  SquareMatrix<T> vectors;     ///< in columns
  std::vector<double> bounds;  ///< n x n: of the error of each entry of `vectors`, up to a column's length
  std::vector<std::size_t> group;  ///< eigenvalues with the same number cannot be told apart
};

/// Eigenvalues closer than this, relative to the larger, count as one: the rounding of the parameters moves
/// them as far.
inline constexpr double inseparable = 0x1p-50;

/// Columns of `vectors` approximate all eigenvectors.
[[nodiscard]] Eigensystem<Ball> enclose_eigensystem(const SquareMatrix<Ball>& a, const SquareMatrix<Ball>& b,
                                                    SquareMatrix<Ball> vectors);
[[nodiscard]] Eigensystem<ComplexBall> enclose_eigensystem(const SquareMatrix<ComplexBall>& a,
                                                           const SquareMatrix<ComplexBall>& b,
                                                           SquareMatrix<ComplexBall> vectors);

}  // namespace qdot
