#pragma once
// Small dense matrices in 80 bits: what enclosures begin from, and what matrices of doubles are decomposed in
// (dense_matrix.hpp). Eigen's decompositions for one real and one complex type, compiled here once: as
// templates they would cost every file that uses them half a minute.

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

/// By elimination with full pivoting; no numbers that mean anything where A is singular.
[[nodiscard]] LongMatrix inverse(const LongMatrix& a);
[[nodiscard]] LongComplexMatrix inverse(const LongComplexMatrix& a);
/// B^-1 A.
[[nodiscard]] LongComplexMatrix quotient(const LongComplexMatrix& a, const LongComplexMatrix& b);
/// The same; no value where B is singular.
[[nodiscard]] std::optional<LongMatrix> quotient(const LongMatrix& a, const LongMatrix& b);

[[nodiscard]] long double determinant(const LongMatrix& a);

/// By QR with columns exchanged: the Moore-Penrose inverse without pivots below `threshold` times the
/// largest, and the number of those above it.
[[nodiscard]] LongMatrix pseudo_inverse(const LongMatrix& a, long double threshold);
[[nodiscard]] Eigen::Index rank(const LongMatrix& a, long double threshold);

[[nodiscard]] LongComplexVector eigenvalues(const LongMatrix& a);
/// Of a symmetric A, ascending.
[[nodiscard]] LongVector symmetric_eigenvalues(const LongMatrix& a);

/// A R = R diag(values); columns of R have length 1.
struct LongEigenvectors {
  LongComplexVector values;
  LongComplexMatrix columns;
};
[[nodiscard]] LongEigenvectors eigenvectors(const LongMatrix& a);

/// K v = w M v for symmetric K and M; columns v with v.M v = 1, w ascending. No value where M is not positive
/// definite.
struct LongAxes {
  LongVector values;
  LongMatrix vectors;
};
[[nodiscard]] std::optional<LongAxes> principal_axes(const LongMatrix& k, const LongMatrix& m);

/// A = Q T Q^H, T upper triangular with the eigenvalues on its diagonal. No value where the iteration fails.
struct LongSchur {
  LongComplexMatrix t, q;
};
[[nodiscard]] std::optional<LongSchur> schur_form(const LongComplexMatrix& a);

}  // namespace qdot
