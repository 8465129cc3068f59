#pragma once
// M x = b in double-doubles, as linear_system.hpp has it in doubles.

#include <span>

#include "core/numerics/double_double.hpp"
#include "core/numerics/linear_system.hpp"

namespace qdot {

/// Replaces M (n x n, by rows) by its triangular factors. False when a pivot is lost in round-off:
/// |pivot| <= 4 n 2^-104 of its row's scale and of what it is the sum of (lost_pivot.hpp).
[[nodiscard]] bool factor_linear(std::size_t n, std::span<DoubleDouble> m, RowOrder& row) noexcept;

/// Replaces one right-hand side b by the solution x, with the factors of M.
void substitute_linear(std::size_t n, std::span<const DoubleDouble> m, const RowOrder& row,
                       std::span<DoubleDouble> b) noexcept;

}  // namespace qdot
