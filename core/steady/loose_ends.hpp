#pragma once
// Curves of equilibria that begin or end where nothing is known to happen: they were not told apart.

#include <span>

#include "core/steady/branches.hpp"

namespace qdot {

/// Whether a branch begins or ends between two columns, the values of the parameter at which equilibria were
/// found, with no critical value between them, and none of `elsewhere`.
[[nodiscard]] bool has_loose_ends(std::span<const EquilibriumBranch> branches,
                                  std::span<const CriticalValue> critical, std::span<const double> elsewhere);

}  // namespace qdot
