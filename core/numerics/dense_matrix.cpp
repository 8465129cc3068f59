#include "core/numerics/dense_matrix.hpp"

#include <algorithm>
#include <limits>

#include "core/numerics/long_schur.hpp"
#include "core/numerics/symmetric_matrix.hpp"

namespace qdot {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

LongMatrix widened(const MatrixXd& a) { return a.cast<long double>(); }

}  // namespace

VectorXd solve(const MatrixXd& a, const VectorXd& b) {
  const auto x = quotient(LongMatrix(b.cast<long double>()), widened(a));
  return x ? VectorXd(x->col(0).cast<double>()) : VectorXd::Constant(b.size(), missing);
}

MatrixXd inverse(const MatrixXd& a) {
  const auto x = quotient(LongMatrix(LongMatrix::Identity(a.rows(), a.cols())), widened(a));
  return x ? MatrixXd(x->cast<double>()) : MatrixXd::Constant(a.rows(), a.cols(), missing);
}

double determinant(const MatrixXd& a) { return static_cast<double>(determinant(widened(a))); }

/// Of numbers that were rounded to doubles.
MatrixXd pseudo_inverse(const MatrixXd& a, double threshold) {
  const auto rounding = std::numeric_limits<double>::epsilon() * static_cast<long double>(a.rows());
  return pseudo_inverse(widened(a), std::max(rounding, static_cast<long double>(threshold))).cast<double>();
}

Eigen::Index rank(const MatrixXd& a, double threshold) {
  return rank(widened(a), static_cast<long double>(threshold));
}

Eigen::VectorXcd eigenvalues(const MatrixXd& a) {
  return eigenvalues(widened(a)).cast<std::complex<double>>();
}

VectorXd symmetric_eigenvalues(const MatrixXd& a) { return symmetric_axes(widened(a)).values.cast<double>(); }

VectorXd most_shortened(const MatrixXd& a) {
  const LongMatrix squares = product(widened(a).transpose(), widened(a));
  return symmetric_axes(squares).vectors.col(0).cast<double>();
}

EigenDecomposition eigen_decomposition(const MatrixXd& a) {
  using Complex = std::complex<double>;
  const LongEigenvectors found = eigenvectors(widened(a));
  return {found.values.cast<Complex>(), found.columns.cast<Complex>(),
          inverse(found.columns).cast<Complex>()};
}

std::optional<PrincipalAxes> principal_axes(const MatrixXd& k, const MatrixXd& m) {
  const auto found = principal_axes(widened(k), widened(m));
  if (!found) return std::nullopt;
  return PrincipalAxes{found->values.cast<double>(), found->vectors.cast<double>()};
}

}  // namespace qdot
