#pragma once
// What has to vanish where a system rests at a position that is given: the forces g(q), or, with constraints,
// what their multipliers leave of them (core/steady/surface_forces.hpp), and the constraints themselves.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/steady/surface_forces.hpp"

namespace qdot {

/// The parameters with one that stands in for the unknown: it must not count as vanishing.
[[nodiscard]] Reals with_unknown(const Scene& scene, const Reals& parameters, const std::string& unknown);

struct PositionStatics {
  std::optional<SurfaceStatics> surface;   ///< only with constraints
  std::optional<SteadyForces> on_surface;  ///< what vanishes there, instead of the statics' forces
  std::shared_ptr<const Statics> statics;  ///< its x: the kept coordinates, then the multipliers
};

/// Throws what Dynamics::statics, surface_statics and derive_surface_forces throw.
[[nodiscard]] PositionStatics position_statics(const Dynamics& dynamics, const Reals& parameters);

/// The position in y = (q, q') on the surface of the constraints, where the rates of all coordinates that
/// have no momenta of their own are 0. Coordinates that are not `given` follow from the constraints, y being
/// near. It stays as it is where a constraint depends on the parameter `unknown`. Throws InconsistentState
/// where what is given obeys no constraints.
[[nodiscard]] Reals position_on_surface(const Dynamics& dynamics, const Reals& parameters, const Reals& y,
                                        const std::vector<bool>& given, const std::string& unknown);

/// How many coordinates may be left out for that.
[[nodiscard]] std::size_t dependent_coordinates(const Dynamics& dynamics, const std::string& unknown);

}  // namespace qdot
