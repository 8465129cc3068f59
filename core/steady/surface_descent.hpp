#pragma once
// The way downhill on the surface of holonomic constraints: where a motion with strong damping from a start
// comes to rest (core/steady/gradient_flow.hpp), the inertia of what the constraints allow being its measure.

#include <optional>
#include <span>
#include <vector>

#include "core/steady/surface_statics.hpp"

namespace qdot {

struct LowestPlace {
  std::vector<double> x;      ///< (q, lambda)
  std::vector<double> sizes;  ///< of each q: what displacements count as large, by the start
};

/// The place in which that ends; `start` = (q, lambda) itself, brought onto the surface, where no force acts
/// along it. No value where no end is reached. `constants` are the reduction's.
[[nodiscard]] std::optional<LowestPlace> lowest_downhill(const SurfaceStatics& whole,
                                                         std::span<const double> constants,
                                                         std::span<const double> start);

}  // namespace qdot
