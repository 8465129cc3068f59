#pragma once
// Coordinates that the forces decide at an equilibrium. What may rest anywhere, alone or with others that
// move along, has a place that no formula of the parameters tells, whatever its number is like.

#include <vector>

#include "core/closed/linear_motions.hpp"

namespace qdot {

/// Of x: whether no small displacement that leaves all forces zero changes it. Of one coordinate: whether a
/// force depends on it. `values` have those of x.
[[nodiscard]] std::vector<bool> decided_coordinates(const LinearMotions& motions, const ExactValues& values);

}  // namespace qdot
