#include "core/numerics/dense_matrix.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace qdot {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd solve(const MatrixXd& a, const VectorXd& b) { return a.partialPivLu().solve(b); }

MatrixXd solve_columns(const MatrixXd& a, const MatrixXd& b) { return a.partialPivLu().solve(b); }

MatrixXd inverse(const MatrixXd& a) { return a.partialPivLu().inverse(); }

double determinant(const MatrixXd& a) { return a.determinant(); }

MatrixXd pseudo_inverse(const MatrixXd& a) { return a.completeOrthogonalDecomposition().pseudoInverse(); }

Eigen::Index rank(const MatrixXd& a, double threshold) {
  Eigen::JacobiSVD<MatrixXd> decomposition(a);
  decomposition.setThreshold(threshold);
  return decomposition.rank();
}

Eigen::VectorXcd eigenvalues(const MatrixXd& a) {
  return Eigen::EigenSolver<MatrixXd>(a, /*computeEigenvectors=*/false).eigenvalues();
}

VectorXd symmetric_eigenvalues(const MatrixXd& a) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(a, Eigen::EigenvaluesOnly).eigenvalues();
}

EigenDecomposition eigen_decomposition(const MatrixXd& a) {
  const Eigen::EigenSolver<MatrixXd> solver(a);
  Eigen::MatrixXcd right = solver.eigenvectors(), left = right.partialPivLu().inverse();
  return {solver.eigenvalues(), std::move(right), std::move(left)};
}

std::optional<PrincipalAxes> principal_axes(const MatrixXd& k, const MatrixXd& m) {
  if (Eigen::LLT<MatrixXd>(m).info() != Eigen::Success) return std::nullopt;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(k, m);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return PrincipalAxes{solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace qdot
