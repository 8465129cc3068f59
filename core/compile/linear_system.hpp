#pragma once
// M x = b for the few unknowns of a mechanical system.

#include <cstddef>
#include <span>

namespace qdot {

inline constexpr std::size_t largest_system = 16;

/// Solves M x = b for each right-hand side, M given by rows (n x n), b and x by right-hand sides (k x n).
/// Gaussian elimination with row pivoting scaled by the rows' largest entries (Golub and Van Loan, Matrix
/// Computations, 4th ed., 3.4). False when a pivot is lost in round-off: |pivot| <= 4 n eps of its row's
/// scale.
[[nodiscard]] bool solve_linear(std::size_t n, std::span<double> m, std::span<double> b) noexcept;

}  // namespace qdot
