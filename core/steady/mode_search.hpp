#pragma once
// The modes of M u'' + D u' + K u = 0 about one place,
// with bounds (core/steady/modes.hpp has the equations).

#include <vector>

#include "core/steady/linearization.hpp"
#include "core/steady/mode.hpp"

namespace qdot {

/// All modes by omega, at 0 in the order of ModeKind, their shapes in all N coordinates: one rigid mode for
/// each ignored coordinate, and those of the kept ones.
[[nodiscard]] std::vector<Mode> modes_of(const Linearization& linearization);

}  // namespace qdot
