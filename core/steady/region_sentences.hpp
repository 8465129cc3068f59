#pragma once
// Where in the region of a search something happened, in words.

#include <string>

#include "core/steady/search_region.hpp"

namespace qdot {

/// "Near x = 0 and y = 1", of the unknowns.
[[nodiscard]] std::string place_named(const Scene& scene, const SteadyProblem& problem, const Box& unknowns);
/// "Where x lies between 0 and 1, the forces are too small to tell whether they vanish."
[[nodiscard]] std::string undecided(const Scene& scene, const SteadyProblem& problem, const Box& unknowns);

/// Why a place is left out where the mass matrix has no inverse. `kept`: all kept coordinates.
[[nodiscard]] std::string without_inertia(const Scene& scene, const SteadyProblem& problem, const Box& kept);

}  // namespace qdot
