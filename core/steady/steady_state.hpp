#pragma once
// The state y = (q, q') of a steady motion, in which the coordinates that are left after Routh's reduction
// rest and the ignored ones move at constant rates (core/dynamics/statics.hpp).

#include <span>
#include <vector>

#include "core/dynamics/statics.hpp"

namespace qdot {

/// The state with the kept coordinates at rest in x, and the ignored ones where y has them, moving at their
/// steady rates. Throws Error(invalid_state) where such a rate has no finite value.
[[nodiscard]] std::vector<double> steady_state(const Statics& statics, std::span<const double> constants,
                                               std::span<const double> x, std::span<const double> y);

}  // namespace qdot
