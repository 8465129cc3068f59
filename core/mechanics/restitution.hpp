#pragma once
// Coefficients of restitution: e of the speed at which bodies meet is left when they part, 0 <= e <= 1. A
// number that a scene writes is checked when it is read (parsed_impact.hpp), an expression of parameters
// here.

#include <span>

#include "core/mechanics/parsed_scene.hpp"

namespace qdot {

/// Of that impact, which has one.
[[nodiscard]] double restitution_of(const ParsedImpact& impact, const ParsedScene& scene,
                                    std::span<const double> parameters);

/// Throws Error(invalid_parameters) where one is not between 0 and 1.
void refuse_wrong_restitutions(const ParsedScene& scene, std::span<const double> parameters);

}  // namespace qdot
