#pragma once
// The way downhill on the surface of holonomic constraints: where a search for an equilibrium may start anew.

#include <span>
#include <vector>

#include "core/steady/surface_statics.hpp"

namespace qdot {

/// Places x = (q, lambda) on the steepest way down from `start`, each a tenth of the coordinates' sizes
/// after the one before it, up to where the forces along the surface turn against the way. `constants` are
/// the reduction's.
[[nodiscard]] std::vector<std::vector<double>> places_downhill(const SurfaceStatics& whole,
                                                               std::span<const double> constants,
                                                               std::span<const double> start);

}  // namespace qdot
