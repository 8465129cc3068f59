#pragma once
// The small motion of one coordinate x about a steady motion with a given momentum p, by the place:
//
//   g(x; p) = a + b p^2 = 0   holds it there,   lambda = K(x; p)/M(x)   with p^2 = -a/b
//
// such as k/(m r^3) on Kepler's circle and g (1 + 3 cos^2)/(l cos) on a cone, where the place itself has no
// formula by p, or a longer one (Landau, Lifshitz, Mechanics, 3rd ed., section 14).

#include <optional>

#include "core/closed/exact_mode.hpp"
#include "core/closed/linear_motions.hpp"
#include "core/closed/mode_derivation.hpp"

namespace qdot {

/// `values` has those of x and p.
[[nodiscard]] std::optional<ModeForms> mode_by_place(const LinearMotions& motions, const ExactValues& values);

}  // namespace qdot
