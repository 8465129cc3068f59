#pragma once
// Matrices of small motions as numbers.

#include "core/steady/modes.hpp"
#include "core/steady/small_motions.hpp"

namespace qdot {

/// n x n of `entries` from place `first` on, rows of `width` entries.
[[nodiscard]] SquareMatrix<Ball> square_matrix(const std::vector<Ball>& entries, std::size_t n,
                                               std::size_t width, std::size_t first = 0);

/// Mass, stiffness, and the skew and the symmetric part of the rates, empty where zero. What is zero to
/// within its error is exactly zero.
void write_matrices(const SmallMotions& motions, Modes& modes);

}  // namespace qdot
