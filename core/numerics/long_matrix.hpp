#pragma once
// Small dense matrices in 80 bits: what enclosures begin from, and what matrices of doubles are decomposed in
// (dense_matrix.hpp). Plain loops over entries: the templates of Eigen's decompositions would cost half a
// minute of compiling for these scalars.

#include <Eigen/Core>
#include <complex>
#include <optional>

#include "core/numerics/ball_matrix.hpp"

namespace qdot {

using LongComplex = std::complex<long double>;
using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
using LongComplexMatrix = Eigen::Matrix<LongComplex, Eigen::Dynamic, Eigen::Dynamic>;
using LongComplexVector = Eigen::Matrix<LongComplex, Eigen::Dynamic, 1>;

/// The middles of balls, rounded, and numbers of 80 bits as balls of radius 0.
[[nodiscard]] LongMatrix middles(const SquareMatrix<Ball>& a);
[[nodiscard]] LongComplexMatrix middles(const SquareMatrix<ComplexBall>& a);
[[nodiscard]] SquareMatrix<Ball> as_balls(const LongMatrix& a);
[[nodiscard]] SquareMatrix<ComplexBall> as_balls(const LongComplexMatrix& a);

/// A B, entry by entry.
[[nodiscard]] LongMatrix product(const LongMatrix& a, const LongMatrix& b);

/// By elimination with full pivoting; no numbers that mean anything where A is singular.
[[nodiscard]] LongMatrix inverse(const LongMatrix& a);
[[nodiscard]] LongComplexMatrix inverse(const LongComplexMatrix& a);
/// B^-1 A; no value where B is singular.
[[nodiscard]] std::optional<LongMatrix> quotient(const LongMatrix& a, const LongMatrix& b);

[[nodiscard]] long double determinant(const LongMatrix& a);

/// By QR with columns exchanged: the Moore-Penrose inverse without pivots below `threshold` times the
/// largest, and the number of those above it.
[[nodiscard]] LongMatrix pseudo_inverse(const LongMatrix& a, long double threshold);
[[nodiscard]] Eigen::Index rank(const LongMatrix& a, long double threshold);

}  // namespace qdot
