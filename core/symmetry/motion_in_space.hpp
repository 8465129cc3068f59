#pragma once
// What a change of the coordinates does to the bodies of a scene, where it moves all of them as one.

#include <optional>

#include "core/mechanics/parsed_scene.hpp"
#include "core/symmetry/point_change.hpp"

namespace qdot {

/// dr = d along an axis (translation), t d (uniform), e x r (rotation about the axis e through the origin),
/// e x (r - c) (offset_rotation), e x r + h e (screw); each times a number, which is negative where
/// `reversed`.
struct MotionInSpace {
  enum class Kind { translation, uniform, rotation, offset_rotation, screw } kind{};
  std::size_t axis{};  ///< 0, 1, 2 for x, y, z; in a plane all rotations are about 2
  bool reversed{false};
};

/// The places of a scene's bodies, and where those point that turn in the plane, with `replacements` put in,
/// in the Lagrangian's graph, a copy of the scene's.
[[nodiscard]] std::vector<Vector> places_of_bodies(const ParsedScene& scene, const Lagrangian& lagrangian,
                                                   std::span<const Replacement> replacements);

/// None where the bodies move otherwise, or there are none. `scale`: what rotations are multiplied by, but
/// for their sign.
[[nodiscard]] std::optional<MotionInSpace> motion_in_space(const std::vector<Vector>& places,
                                                           const Symbols& symbols, const PointChange& change,
                                                           const Expression& scale);

}  // namespace qdot
