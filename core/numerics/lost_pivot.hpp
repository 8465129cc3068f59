#pragma once
// Whether rounding is all that is left of a pivot, whatever units rows and columns have.
//
// Gaussian elimination gives the factors of a matrix that differs from A by a few eps |L||U| (Golub and Van
// Loan, Matrix Computations, 4th ed., 3.1.2; Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed.,
// 9.3). To first order that moves pivot k by
//
//   |w| |L||U| |z|,   w = (-l_k L^-1, 1),   z = (-U^-1 u_k, 1),
//
// with row k of L, column k of U, and the blocks before them. Rows and columns of A in other units change it
// as they change the pivot: of [M A^T; A 0] neither depends on whether M is of an atom or of a star.

#include <array>
#include <cmath>
#include <cstddef>

#include "core/numerics/row_order.hpp"

namespace qdot {

/// |w||L||U||z| of pivot k, once the columns before it are eliminated and its row is chosen. `entry(i n + j)`
/// is that of the matrix with the factors in their places.
template <class Entry>
[[nodiscard]] double size_in_pivot(std::size_t n, std::size_t k, const RowOrder& row, Entry entry) {
  const auto at = [&](std::size_t i, std::size_t j) { return entry(row[i] * n + j); };
  std::array<double, largest_system> w, z;  // k + 1 of each are used
  w[k] = z[k] = 1;
  for (std::size_t p = k; p-- > 0;) {
    double of_w = 0, of_z = 0;
    for (std::size_t i = p + 1; i <= k; ++i) {
      of_w -= w[i] * at(i, p);
      of_z -= at(p, i) * z[i];
    }
    w[p] = of_w;
    z[p] = of_z / at(p, p);
  }
  double size = 0;
  for (std::size_t p = 0; p <= k; ++p) {
    double of_rows = std::abs(w[p]), of_columns = 0;
    for (std::size_t i = p + 1; i <= k; ++i) of_rows += std::abs(w[i] * at(i, p));
    for (std::size_t j = p; j <= k; ++j) of_columns += std::abs(at(p, j) * z[j]);
    size += of_rows * of_columns;
  }
  return size;
}

}  // namespace qdot
