#pragma once
// M x = b for the few unknowns of a mechanical system.

#include <cstddef>
#include <span>

#include "core/numerics/row_order.hpp"

namespace qdot {

/// Replaces M (n x n, by rows) by its triangular factors. False as for solve_linear.
[[nodiscard]] bool factor_linear(std::size_t n, std::span<double> m, RowOrder& row) noexcept;

/// Replaces one right-hand side b by the solution x, with the factors of M.
void substitute_linear(std::size_t n, std::span<const double> m, const RowOrder& row,
                       std::span<double> b) noexcept;

/// Solves M x = b for each right-hand side, M given by rows (n x n), b and x by right-hand sides (k x n).
/// Gaussian elimination with row pivoting scaled by the rows' largest entries (Golub and Van Loan, Matrix
/// Computations, 4th ed., 3.4). False when a pivot is lost in round-off: |pivot| <= 4 n eps of its row's
/// scale and of what it is the sum of (lost_pivot.hpp), which no choice of units changes.
[[nodiscard]] bool solve_linear(std::size_t n, std::span<double> m, std::span<double> b) noexcept;

/// Matrices middle + sum_k w_k moving_k + E over all |w_k| <= 1 and |E| <= radius in each entry, n x n by
/// rows.
struct MatrixFamily {
  std::span<const double> middle, radius;
  std::span<const double> moving{};  ///< one matrix after another
};

/// A bound of |x_i| for all x with M x = b, over every M of a family and every b with |b| <= rho; infinite
/// where none is found. For Y near the inverse of `middle`, |x| <= |Y| rho + |1 - Y M| |x|. What moves
/// together is taken together: |Y moving_k| is much less than |Y| |moving_k|. Source: Rump, Verification
/// methods, Acta Numerica 19 (2010) 287, section 10.
void bound_solution(std::size_t n, const MatrixFamily& matrices, std::span<const double> rho,
                    std::span<double> bound) noexcept;

}  // namespace qdot
