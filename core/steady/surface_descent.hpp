#pragma once
// The way downhill on the surface of holonomic constraints, as core/steady/equilibrium.cpp goes down without
// them: where the search for the stable equilibrium below a start begins.

#include <optional>
#include <span>
#include <vector>

#include "core/steady/surface_statics.hpp"

namespace qdot {

/// The place x = (q, lambda) that Newton's iteration with |K| on the surface comes to from `start`, each step
/// brought back onto the surface and doing work downhill; `start` itself, brought onto the surface, where no
/// force acts along it. No value where no end is reached. `constants` are the reduction's.
[[nodiscard]] std::optional<std::vector<double>> lowest_downhill(const SurfaceStatics& whole,
                                                                 std::span<const double> constants,
                                                                 std::span<const double> start);

}  // namespace qdot
