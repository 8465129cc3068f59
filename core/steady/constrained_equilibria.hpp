#pragma once
// All equilibria of a scene whose coordinates obey holonomic constraints: the zeros of its forces on their
// surface (core/steady/surface_forces.hpp), searched as those of any other scene. Each is found once more
// with the constraints' multipliers, which are the forces that hold it there, and its stability is that of
// its small motions on the surface (core/steady/constrained_modes.hpp): the potential's least values there
// are stable (Lagrange, Dirichlet).

#include <optional>
#include <vector>

#include "core/steady/equilibria.hpp"
#include "core/steady/surface_problem.hpp"

namespace qdot {

struct ConstrainedEquilibria {
  Equilibria found;
  /// Of each of found.states, by constraint, in their own units; none where they could not be enclosed.
  std::vector<std::optional<std::vector<Ball>>> multipliers;
};

/// `y` gives free coordinates their values, as in equilibria.hpp. Throws what surface_problem throws.
[[nodiscard]] ConstrainedEquilibria constrained_equilibria(const Dynamics& dynamics, const Reals& parameters,
                                                           const Reals& y);

/// The same for a problem that is there, and for other constants of it: `problem.constants` are those of
/// `problem.steady`, too.
[[nodiscard]] ConstrainedEquilibria constrained_equilibria(const SurfaceProblem& problem);

}  // namespace qdot
