#pragma once
// Small linear systems with expressions for entries, for printing; numbers are solved in core/compile.

#include <vector>

#include "core/expr/expression.hpp"

namespace qdot {

using Matrix = std::vector<std::vector<Expression>>;  ///< rows

inline constexpr std::size_t largest_written_system = 3;

/// det m by expansion along the first row, not simplified.
[[nodiscard]] Expression determinant(const Matrix& m);

/// x with m x = b by Cramer's rule, each in short form. For at most largest_written_system unknowns.
[[nodiscard]] std::vector<Expression> cramer(const Matrix& m, const std::vector<Expression>& b);

}  // namespace qdot
