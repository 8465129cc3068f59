#include "core/numerics/long_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace qdot {
namespace {

using Index = Eigen::Index;

Index row_of(std::size_t i) { return static_cast<Index>(i); }

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

/// P A Q = L U, both exchanges such that each pivot is the largest entry that is left (G. H. Golub, C. F. Van
/// Loan, Matrix Computations, 4th ed., section 3.4.8).
template <class Matrix>
class Elimination {
 public:
  explicit Elimination(Matrix a) : lu_(std::move(a)) {
    for (Index k = 0; k < size(); ++k) {
      const auto [row, column] = largest_from(k);
      if (std::abs(lu_(row, column)) == 0) break;
      exchange(k, row, column);
      eliminate(k);
    }
    const auto rounding = std::numeric_limits<long double>::epsilon() * static_cast<long double>(size());
    while (rank_ < size() && std::abs(lu_(rank_, rank_)) > rounding * std::abs(lu_(0, 0))) ++rank_;
  }

  [[nodiscard]] bool singular() const { return rank_ < size(); }

  [[nodiscard]] auto determinant() const {
    typename Matrix::Scalar product(1);
    for (Index k = 0; k < size(); ++k) product *= lu_(k, k);
    return odd_ ? -product : product;
  }

  /// A^-1 B; zeros in place of what a singular A leaves open.
  [[nodiscard]] Matrix solve(Matrix b) const {
    for (std::size_t k = 0; k < rows_.size(); ++k) b.row(row_of(k)).swap(b.row(rows_[k]));
    for (Index j = 0; j < b.cols(); ++j) {
      for (Index k = 0; k < size(); ++k) {
        for (Index i = k + 1; i < size(); ++i) b(i, j) -= lu_(i, k) * b(k, j);
      }
      for (Index k = rank_; k < size(); ++k) b(k, j) = 0;
      for (Index k = rank_ - 1; k >= 0; --k) {
        b(k, j) /= lu_(k, k);
        for (Index i = 0; i < k; ++i) b(i, j) -= lu_(i, k) * b(k, j);
      }
    }
    for (std::size_t k = columns_.size(); k-- > 0;) b.row(row_of(k)).swap(b.row(columns_[k]));
    return b;
  }

 private:
  [[nodiscard]] Index size() const { return lu_.rows(); }

  [[nodiscard]] std::pair<Index, Index> largest_from(Index k) const {
    std::pair<Index, Index> place{k, k};
    long double largest = 0;
    for (Index j = k; j < size(); ++j) {
      for (Index i = k; i < size(); ++i) {
        if (const long double entry = std::abs(lu_(i, j)); entry > largest) {
          largest = entry;
          place = {i, j};
        }
      }
    }
    return place;
  }

  void exchange(Index k, Index row, Index column) {
    lu_.row(k).swap(lu_.row(row));
    lu_.col(k).swap(lu_.col(column));
    rows_.push_back(row);
    columns_.push_back(column);
    odd_ = odd_ != ((row != k) != (column != k));
  }

  void eliminate(Index k) {
    for (Index i = k + 1; i < size(); ++i) lu_(i, k) /= lu_(k, k);
    for (Index j = k + 1; j < size(); ++j) {
      for (Index i = k + 1; i < size(); ++i) lu_(i, j) -= lu_(i, k) * lu_(k, j);
    }
  }

  Matrix lu_;
  std::vector<Index> rows_, columns_;  ///< what changed places with number k
  Index rank_ = 0;
  bool odd_ = false;
};

template <class Matrix>
Matrix inverse_of(const Matrix& a) {
  return Elimination<Matrix>(a).solve(Matrix::Identity(a.rows(), a.cols()));
}

/// What is left of column j beside the first `count` columns of Q, which are orthonormal.
void take_off(LongMatrix& a, Index j, const LongMatrix& q, Index count) {
  for (Index k = 0; k < count; ++k) {
    long double share = 0;
    for (Index i = 0; i < a.rows(); ++i) share += q(i, k) * a(i, j);
    for (Index i = 0; i < a.rows(); ++i) a(i, j) -= share * q(i, k);
  }
}

long double length_of_column(const LongMatrix& a, Index j) {
  long double sum = 0;
  for (Index i = 0; i < a.rows(); ++i) sum += a(i, j) * a(i, j);
  return std::sqrt(sum);
}

/// Orthonormal columns that span those of A, apart from lengths below `threshold` times the largest: the
/// longest that is left is the next, and is made orthogonal to those before it twice.
LongMatrix orthonormal_range(LongMatrix a, long double threshold) {
  LongMatrix q(a.rows(), std::min(a.rows(), a.cols()));
  long double largest = 0;
  for (Index k = 0; k < q.cols(); ++k) {
    Index next = 0;
    long double length = 0;
    for (Index j = 0; j < a.cols(); ++j) {
      if (const long double left = length_of_column(a, j); left > length) {
        length = left;
        next = j;
      }
    }
    largest = std::max(largest, length);
    if (!(length > threshold * largest)) return q.leftCols(k);
    take_off(a, next, q, k);
    const long double norm = length_of_column(a, next);
    for (Index i = 0; i < a.rows(); ++i) q(i, k) = a(i, next) / norm;
    for (Index j = 0; j < a.cols(); ++j) take_off(a, j, q, k + 1);
    a.col(next).setZero();
  }
  return q;
}

}  // namespace

LongMatrix middles(const SquareMatrix<Ball>& a) { return rounded_entries<LongMatrix>(a); }
LongComplexMatrix middles(const SquareMatrix<ComplexBall>& a) {
  return rounded_entries<LongComplexMatrix>(a);
}
SquareMatrix<Ball> as_balls(const LongMatrix& a) { return exact_entries<Ball>(a); }
SquareMatrix<ComplexBall> as_balls(const LongComplexMatrix& a) { return exact_entries<ComplexBall>(a); }

LongMatrix product(const LongMatrix& a, const LongMatrix& b) {
  LongMatrix result = LongMatrix::Zero(a.rows(), b.cols());
  for (Index i = 0; i < a.rows(); ++i) {
    for (Index j = 0; j < b.cols(); ++j) {
      for (Index k = 0; k < a.cols(); ++k) result(i, j) += a(i, k) * b(k, j);
    }
  }
  return result;
}

LongMatrix inverse(const LongMatrix& a) { return inverse_of(a); }
LongComplexMatrix inverse(const LongComplexMatrix& a) { return inverse_of(a); }

std::optional<LongMatrix> quotient(const LongMatrix& a, const LongMatrix& b) {
  const Elimination lu(b);
  if (lu.singular()) return std::nullopt;
  return lu.solve(a);
}

long double determinant(const LongMatrix& a) { return Elimination(a).determinant(); }

/// A = Q C with C = Q^T A, C^T = Z S with S = Z^T C^T: A^+ = Z S^-T Q^T.
LongMatrix pseudo_inverse(const LongMatrix& a, long double threshold) {
  const LongMatrix q = orthonormal_range(a, threshold);
  const LongMatrix c = product(q.transpose(), a);
  const LongMatrix z = orthonormal_range(c.transpose(), 0);
  return product(z, Elimination(product(c, z)).solve(q.transpose()));
}

Index rank(const LongMatrix& a, long double threshold) { return orthonormal_range(a, threshold).cols(); }

}  // namespace qdot
