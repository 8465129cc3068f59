#pragma once
// How many unknowns a mechanical system has, and the order in which elimination takes its rows.

#include <array>
#include <cstddef>

namespace qdot {

/// Twelve coordinates and eight constraints.
inline constexpr std::size_t largest_system = 20;

/// The order of the rows that pivoting chose.
using RowOrder = std::array<std::size_t, largest_system>;

}  // namespace qdot
