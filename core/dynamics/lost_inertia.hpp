#pragma once
// What parameters that are 0 take from the equations of motion M q'' = f. A factor that all terms of an
// equation share is divided out of it (core/mechanics/equations_of_motion.hpp): where it is 0 the equation
// vanishes, and its limit moves the coordinate. What else they take from M may leave it without an inverse.

#include <cstddef>
#include <optional>
#include <vector>

#include "core/mechanics/inertia_check.hpp"
#include "core/mechanics/model.hpp"

namespace qdot {

struct LostInertia {
  std::vector<std::size_t> limits;  ///< coordinates whose equation vanishes, so that its limit stands for it
  std::vector<std::size_t> zeros;   ///< parameters that are 0 and stand in M
  /// With these M has no inverse in any state; with constraints only coordinates of no mass that none holds.
  std::optional<InertiaFault> fault;
};

/// With any value of the parameter number `varied`, where there is one.
[[nodiscard]] LostInertia lost_inertia(const Model& model, const Reals& parameters,
                                       std::optional<std::size_t> varied = {});

}  // namespace qdot
