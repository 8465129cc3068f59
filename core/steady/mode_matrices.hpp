#pragma once
// Matrices of small motions as numbers.

#include "core/steady/small_motions.hpp"

namespace qdot {

/// n x n of `entries` from place `first` on, rows of `width` entries.
[[nodiscard]] SquareMatrix<Ball> square_matrix(const std::vector<Ball>& entries, std::size_t n,
                                               std::size_t width, std::size_t first = 0);

/// By rows; what is zero to within its error is exactly zero.
[[nodiscard]] std::vector<double> by_rows(const SquareMatrix<Ball>& a);
/// (A + sign A^T)/2 by rows, or nothing where that is zero.
[[nodiscard]] std::vector<double> part(const SquareMatrix<Ball>& a, int sign);

}  // namespace qdot
