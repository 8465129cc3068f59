#pragma once
// Loops over the rows of tables, such as the states of a motion: rows x columns, row-major, with an even
// number of columns.

#include <cstddef>
#include <span>
#include <vector>

namespace qdot {

/// The largest magnitude of each column.
[[nodiscard]] std::vector<double> largest_in_columns(std::span<const double> table, std::size_t width);

}  // namespace qdot
