#pragma once
// Between a state y = (q, q') of the scene and a steady motion, in which the coordinates that are left after
// Routh's reduction rest and the ignored ones turn at constant rates (core/dynamics/statics.hpp).

#include <span>
#include <vector>

#include "core/dynamics/dynamics.hpp"

namespace qdot {

/// The scene's parameters followed by the momenta of the ignored coordinates in the state y = (q, q').
[[nodiscard]] std::vector<double> constants_at(const Dynamics& dynamics, const Statics& statics,
                                               std::span<const double> parameters, std::span<const double> y);

/// y with the kept coordinates at x and at rest, the ignored ones where y has them, at their steady rates.
[[nodiscard]] std::vector<double> steady_state(const Statics& statics, std::span<const double> constants,
                                               std::span<const double> x, std::span<const double> y);

}  // namespace qdot
