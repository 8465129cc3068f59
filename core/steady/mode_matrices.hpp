#pragma once
// The matrices of small motions, M u'' + D u' + K u = 0 (core/steady/small_motions.hpp), as numbers.

#include <tuple>
#include <vector>

#include "core/steady/small_motions.hpp"

namespace qdot {

/// n x n of `entries` from place `first` on, rows of `width` entries.
[[nodiscard]] SquareMatrix<Ball> square_matrix(const std::vector<Ball>& entries, std::size_t n,
                                               std::size_t width, std::size_t first = 0);

/// Mass, stiffness, and the skew (gyroscopic) and the symmetric part (damping) of the rates, empty where
/// zero. What is zero to within its error is exactly zero.
[[nodiscard]] std::tuple<std::vector<double>, std::vector<double>, std::vector<double>, std::vector<double>>
matrices_by_rows(const SmallMotions& motions);

}  // namespace qdot
