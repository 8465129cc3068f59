#include "core/numerics/dense_matrix.hpp"

#include <Eigen/LU>
#include <Eigen/QR>

#include "core/numerics/long_matrix.hpp"

namespace qdot {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd solve(const MatrixXd& a, const VectorXd& b) { return a.partialPivLu().solve(b); }

MatrixXd inverse(const MatrixXd& a) { return a.partialPivLu().inverse(); }

double determinant(const MatrixXd& a) { return a.determinant(); }

MatrixXd pseudo_inverse(const MatrixXd& a) { return a.completeOrthogonalDecomposition().pseudoInverse(); }

Eigen::Index rank(const MatrixXd& a, double threshold) {
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> decomposition(a);
  decomposition.setThreshold(threshold);
  return decomposition.rank();
}

Eigen::VectorXcd eigenvalues(const MatrixXd& a) {
  return eigenvalues(LongMatrix(a.cast<long double>())).cast<std::complex<double>>();
}

VectorXd symmetric_eigenvalues(const MatrixXd& a) {
  return symmetric_eigenvalues(LongMatrix(a.cast<long double>())).cast<double>();
}

EigenDecomposition eigen_decomposition(const MatrixXd& a) {
  using Complex = std::complex<double>;
  const LongEigenvectors found = eigenvectors(a.cast<long double>());
  return {found.values.cast<Complex>(), found.columns.cast<Complex>(),
          inverse(found.columns).cast<Complex>()};
}

std::optional<PrincipalAxes> principal_axes(const MatrixXd& k, const MatrixXd& m) {
  const auto found = principal_axes(LongMatrix(k.cast<long double>()), LongMatrix(m.cast<long double>()));
  if (!found) return std::nullopt;
  return PrincipalAxes{found->values.cast<double>(), found->vectors.cast<double>()};
}

}  // namespace qdot
