#pragma once
// Where a section of a motion between kinks ends: at the next kink, or where the motion no longer stays on
// one.

#include <vector>

#include "core/integrate/run.hpp"
#include "core/motion/kink_modes.hpp"

namespace qdot {

/// One event for each kink, for a section that begins at time t. A kink at which it begins it meets again
/// only when its u is negative by more than round-off, or than the tolerances where the method is not taylor.
[[nodiscard]] std::vector<EventFunction> kink_ends(const KinkModes& modes, const KinkModes::Way& way,
                                                   double t, Method method, const Tolerances& tolerances);

}  // namespace qdot
