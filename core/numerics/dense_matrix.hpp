#pragma once
// Solutions, eigenvalues and ranks of small dense matrices of doubles, found in 80 bits (long_matrix.hpp).

#include <Eigen/Core>
#include <optional>

namespace qdot {

/// x with A x = b, by elimination with partial pivoting; not finite where A is singular.
[[nodiscard]] Eigen::VectorXd solve(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
[[nodiscard]] Eigen::MatrixXd inverse(const Eigen::MatrixXd& a);
[[nodiscard]] double determinant(const Eigen::MatrixXd& a);

/// The Moore-Penrose inverse: A^+ b is the shortest of the x that bring A x nearest to b.
/// Pivots up to `threshold` times the largest count as zero, as those that rounding leaves do.
[[nodiscard]] Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a, double threshold = 0);

/// The number of pivots above `threshold` times the largest, by QR with columns exchanged.
[[nodiscard]] Eigen::Index rank(const Eigen::MatrixXd& a, double threshold);

[[nodiscard]] Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& a);
/// Of a symmetric A, ascending.
[[nodiscard]] Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& a);

/// The x of length 1 with the shortest A x: A's kernel, where it has one.
[[nodiscard]] Eigen::VectorXd most_shortened(const Eigen::MatrixXd& a);

/// A R = R diag(values), L = R^-1: columns of R are right eigenvectors of length 1, rows of L left ones.
struct EigenDecomposition {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd right, left;
};
[[nodiscard]] EigenDecomposition eigen_decomposition(const Eigen::MatrixXd& a);

/// K v = w M v for symmetric K and positive definite M; columns v with v.M v = 1, w ascending. No value where
/// M is not positive definite.
struct PrincipalAxes {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
[[nodiscard]] std::optional<PrincipalAxes> principal_axes(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m);

}  // namespace qdot
