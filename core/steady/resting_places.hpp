#pragma once
// Places x0 where the forces g vanish for every value of a parameter p, 0 or half a turn of each unknown, as
// at rest in a symmetric position; and what decides where other equilibria come from there.

#include <vector>

#include "core/mechanics/scene.hpp"
#include "core/numerics/box.hpp"
#include "core/steady/steady_forces.hpp"

namespace qdot {

/// g about one place, as functions of what the names say.
struct LastingPlace {
  Box x;                                     ///< of the forces' unknowns
  CompiledFunction conditions;               ///< factors of det g_x, of p
  CompiledFunction changes;                  ///< their slopes, then that of det g_x, of p
  CompiledFunction slopes;                   ///< g_x by rows, of p
  CompiledFunction second, third;            ///< along x0 + s v + s^2 w at s = 0, of (v, w, p)
  std::vector<std::vector<bool>> reflected;  ///< of each reflection that g has there, the unknowns it turns
};

/// Those from which other equilibria may come at some p. `place`: which of the reduction's constants p is.
/// As many forces as unknowns, and few: 2^n places and reflections are tried.
[[nodiscard]] std::vector<LastingPlace> resting_places(const Scene& scene, const SteadyProblem& problem,
                                                       std::size_t place);

}  // namespace qdot
