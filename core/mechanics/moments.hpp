#pragma once
// Principal moments of inertia of a body: I1 = sum of m (y^2 + z^2) and so on, so that none is larger than
// the sum of the other two, and as large only where all of the body lies in a plane. Source: Landau,
// Lifshitz, Mechanics, 3rd ed., section 32.

#include <optional>
#include <string>

#include "core/mechanics/parsed_scene.hpp"
#include "core/numerics/real.hpp"

namespace qdot {

/// "the third principal moment of 'body' is larger than the sum of the other two" where, with these
/// parameters, it surely is.
[[nodiscard]] std::optional<std::string> impossible_moment(const ParsedScene& scene, const Reals& parameters);

/// Throws Error(invalid_parameters) where the moments of a body in space are those of none: with these
/// parameters, or whatever they are. What rounding hides is let pass.
void refuse_impossible_moments(const ParsedScene& scene, const Reals& parameters);

}  // namespace qdot
