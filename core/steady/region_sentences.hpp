#pragma once
// Where in the region of a search something happened, in words.

#include <string>
#include <vector>

#include "core/steady/search_region.hpp"
#include "core/steady/symmetric_changes.hpp"

namespace qdot {

/// "Near x = 0 and y = 1", of the unknowns.
[[nodiscard]] std::string place_named(const Scene& scene, const SteadyProblem& problem, const Box& unknowns);
/// "Where x lies between 0 and 1, the forces are too small to tell whether they vanish."
[[nodiscard]] std::string undecided(const Scene& scene, const SteadyProblem& problem, const Box& unknowns);

/// Of coordinates by place in x.
[[nodiscard]] std::vector<std::string> coordinate_names(const Scene& scene, const SteadyProblem& problem,
                                                        const std::vector<std::size_t>& places);
/// "The small change dx = -y and dy = x", and what is the matter where one leaves no equilibrium by itself.
[[nodiscard]] std::string small_change(const Scene& scene, const SteadyProblem& problem,
                                       const WrittenChange& change);
extern const char* const only_families;

/// Why a search did not end, as far as it is known.
[[nodiscard]] std::string given_up(const Scene& scene, const SteadyProblem& problem);

/// Why a place is left out where the mass matrix has no inverse. `kept`: all kept coordinates.
[[nodiscard]] std::string without_inertia(const Scene& scene, const SteadyProblem& problem, const Box& kept);

}  // namespace qdot
