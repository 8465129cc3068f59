#include "core/numerics/long_matrix.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace qdot {
namespace {

Eigen::Index row_of(std::size_t i) { return static_cast<Eigen::Index>(i); }

long double rounded(const Ball& a) { return a.middle.extended(); }
LongComplex rounded(const ComplexBall& a) { return {rounded(a.re), rounded(a.im)}; }
Ball exactly(long double x) { return {DoubleDouble::of(x), 0}; }
ComplexBall exactly(const LongComplex& z) { return {exactly(z.real()), exactly(z.imag())}; }

template <class Matrix, class T>
Matrix rounded_entries(const SquareMatrix<T>& a) {
  Matrix m(row_of(a.size()), row_of(a.size()));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < a.size(); ++j) m(row_of(i), row_of(j)) = rounded(a(i, j));
  }
  return m;
}

template <class T, class Matrix>
SquareMatrix<T> exact_entries(const Matrix& m) {
  SquareMatrix<T> a(static_cast<std::size_t>(m.cols()));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < a.size(); ++j) a(i, j) = exactly(m(row_of(i), row_of(j)));
  }
  return a;
}

}  // namespace

LongMatrix middles(const SquareMatrix<Ball>& a) { return rounded_entries<LongMatrix>(a); }
LongComplexMatrix middles(const SquareMatrix<ComplexBall>& a) {
  return rounded_entries<LongComplexMatrix>(a);
}
SquareMatrix<Ball> as_balls(const LongMatrix& a) { return exact_entries<Ball>(a); }
SquareMatrix<ComplexBall> as_balls(const LongComplexMatrix& a) { return exact_entries<ComplexBall>(a); }

LongMatrix inverse(const LongMatrix& a) { return a.fullPivLu().inverse(); }
LongComplexMatrix inverse(const LongComplexMatrix& a) { return a.fullPivLu().inverse(); }

LongComplexMatrix quotient(const LongComplexMatrix& a, const LongComplexMatrix& b) {
  return b.fullPivLu().solve(a);
}

std::optional<LongMatrix> quotient(const LongMatrix& a, const LongMatrix& b) {
  const Eigen::FullPivLU<LongMatrix> lu(b);
  if (!lu.isInvertible()) return std::nullopt;
  return lu.solve(a);
}

long double determinant(const LongMatrix& a) { return a.fullPivLu().determinant(); }

LongMatrix pseudo_inverse(const LongMatrix& a, long double threshold) {
  Eigen::CompleteOrthogonalDecomposition<LongMatrix> decomposition(a.rows(), a.cols());
  decomposition.setThreshold(threshold);  // what it does after the last pivot depends on it
  return decomposition.compute(a).pseudoInverse();
}

Eigen::Index rank(const LongMatrix& a, long double threshold) {
  Eigen::CompleteOrthogonalDecomposition<LongMatrix> decomposition(a);
  decomposition.setThreshold(threshold);
  return decomposition.rank();
}

LongComplexVector eigenvalues(const LongMatrix& a) {
  return Eigen::EigenSolver<LongMatrix>(a, /*computeEigenvectors=*/false).eigenvalues();
}

LongVector symmetric_eigenvalues(const LongMatrix& a) {
  return Eigen::SelfAdjointEigenSolver<LongMatrix>(a, Eigen::EigenvaluesOnly).eigenvalues();
}

LongEigenvectors eigenvectors(const LongMatrix& a) {
  const Eigen::EigenSolver<LongMatrix> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

std::optional<LongAxes> principal_axes(const LongMatrix& k, const LongMatrix& m) {
  if (Eigen::LLT<LongMatrix>(m).info() != Eigen::Success) return std::nullopt;
  const Eigen::GeneralizedSelfAdjointEigenSolver<LongMatrix> solver(k, m);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return LongAxes{solver.eigenvalues(), solver.eigenvectors()};
}

std::optional<LongSchur> schur_form(const LongComplexMatrix& a) {
  const Eigen::ComplexSchur<LongComplexMatrix> decomposition(a);
  if (decomposition.info() != Eigen::Success) return std::nullopt;
  return LongSchur{decomposition.matrixT(), decomposition.matrixU()};
}

}  // namespace qdot
