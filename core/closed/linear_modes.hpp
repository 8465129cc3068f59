#pragma once
// Solutions of M u'' + G u' + K u = 0 by the parameters. Of two coordinates that gyroscopic terms couple,
// lambda = omega^2 solves
//
//   (k11 - lambda m11)(k22 - lambda m22) - (k12 - lambda m12)^2 - lambda g^2 = 0,   g = g12 = -g21
//
// (Goldstein, Classical Mechanics, 5.7: the top).

#include <vector>

#include "core/closed/linear_motions.hpp"
#include "core/expr/surd.hpp"

namespace qdot {

/// lambda and the shape, in the coordinates x; no shape of two coordinates that gyroscopic terms couple.
struct LinearMode {
  Surd lambda;
  std::vector<Surd> shape;
  std::vector<std::size_t> group;  ///< the coordinates that it moves, after they fell apart
};

/// All modes at a place, `relations` put in. Those of damped coordinates are missing, and of more than two
/// that do not fall apart (equal_parts.hpp), unless they are three that move together without a force.
[[nodiscard]] std::vector<LinearMode> modes_at(const LinearMotions& motions, const ExactPlace& place,
                                               std::span<const Replacement> relations);

}  // namespace qdot
