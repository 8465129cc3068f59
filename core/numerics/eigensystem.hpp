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

#include <complex>
#include <vector>

#include "core/numerics/ball.hpp"
#include "core/numerics/same_bits.hpp"

namespace qdot {

struct ComplexBall {
  Ball re, im;

  ComplexBall() = default;
  ComplexBall(const Ball& real, const Ball& imaginary = {}) : re(real), im(imaginary) {}  // implicit
};

[[nodiscard]] inline ComplexBall operator+(const ComplexBall& a, const ComplexBall& b) {
  return {a.re + b.re, a.im + b.im};
}
[[nodiscard]] inline ComplexBall operator-(const ComplexBall& a, const ComplexBall& b) {
  return {a.re - b.re, a.im - b.im};
}
[[nodiscard]] inline ComplexBall operator*(const ComplexBall& a, const ComplexBall& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
[[nodiscard]] ComplexBall operator/(const ComplexBall& a, const ComplexBall& b);

[[nodiscard]] inline double magnitude(const Ball& a) { return a.magnitude(); }
[[nodiscard]] inline double magnitude(const ComplexBall& a) {
  return hypotenuse(a.re.magnitude(), a.im.magnitude()) * (1 + 0x1p-50);
}
[[nodiscard]] inline Ball middle_of(const Ball& a) { return {a.middle, 0}; }
[[nodiscard]] inline ComplexBall middle_of(const ComplexBall& a) {
  return {middle_of(a.re), middle_of(a.im)};
}

/// n x n by rows; T is Ball or ComplexBall.
template <class T>
class SquareMatrix {
 public:
  explicit SquareMatrix(std::size_t size) : size_(size), entries_(size * size) {}
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] T& operator()(std::size_t i, std::size_t j) { return entries_[i * size_ + j]; }
  [[nodiscard]] const T& operator()(std::size_t i, std::size_t j) const { return entries_[i * size_ + j]; }

 private:
  std::size_t size_;
  std::vector<T> entries_;
};

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
