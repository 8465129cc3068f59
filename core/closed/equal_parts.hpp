#pragma once
// Small motions of equal parts, M u'' + D u' + K u = 0, in coordinates in which they fall apart. Where
// exchanging coordinates in pairs, and turning the signs of some, leaves M, D and K as they are, no entry
// couples the sums of the pairs to their differences: two of three equal pendulums swing alike, or against
// each other (Landau and Lifshitz, Mechanics, 3rd ed., section 24).

#include <vector>

#include "core/expr/rational_function.hpp"

namespace qdot {

using Entries = std::vector<std::vector<RationalFunction>>;  ///< rows

struct LinearMatrices {
  Entries mass, damping, stiffness;
};

/// Coordinates by number that no entry couples to others.
[[nodiscard]] std::vector<std::vector<std::size_t>> coupled_groups(const LinearMatrices& matrices);

[[nodiscard]] bool is_damped(const LinearMatrices& matrices, const std::vector<std::size_t>& group);

struct FallenApart {
  LinearMatrices matrices;              ///< in new coordinates
  std::vector<std::vector<int>> basis;  ///< basis[i][k]: coordinate i where the k-th new one alone is 1
};

/// Groups of one or two stay as they are; so do those of more than twelve.
[[nodiscard]] FallenApart fallen_apart(LinearMatrices matrices);

}  // namespace qdot
