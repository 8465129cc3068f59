#pragma once
// Coordinates that a motion may carry on and on: angles a turn of which changes nothing, and what nothing
// depends on.

#include <vector>

#include "core/mechanics/model.hpp"

namespace qdot {

/// By coordinate: L, the forces and the constraints have the same values at q and at q + 2 pi, as their forms
/// show.
[[nodiscard]] std::vector<bool> winding_coordinates(const Model& model);

}  // namespace qdot
