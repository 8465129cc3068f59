#pragma once
// What equilibria have to do with impacts: the search for them knows of forces only.

#include <span>
#include <string>

#include "core/dynamics/dynamics.hpp"

namespace qdot::api {

/// What the answer says once of a scene whose impacts return a speed; empty without any.
[[nodiscard]] std::string note_on_walls(const Model& model);

/// That y lies behind what such an impact hits, whose distance is negative there; empty where it does not.
[[nodiscard]] std::string wall_before(const Dynamics& dynamics, std::span<const double> parameters,
                                      std::span<const double> y);

}  // namespace qdot::api
