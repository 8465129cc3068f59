#pragma once
// All equilibria of a scene: the zeros of the forces g(x) = E(x, 0, 0), one turn of each angle and the whole
// domain of each other coordinate searched by interval arithmetic (core/numerics/root_isolation.hpp), so that
// none is lost and each error is a proven bound. Where coordinates are ignorable, the zeros are steady
// motions with the momenta of a given state (Goldstein, Classical Mechanics, 3rd ed., 8.3): the ignorable
// coordinates move uniformly.
//
// g is searched without its denominators, whose zeros (the axis of a spherical pendulum) are no equilibria,
// on each side of its kinks and at them (core/steady/force_system.hpp). Coordinates that no force depends on
// are free: every value of theirs belongs to an equilibrium.

#include <span>
#include <string>
#include <vector>

#include "core/steady/bounded_state.hpp"
#include "core/steady/search_region.hpp"

namespace qdot {

struct Equilibria {
  std::vector<SteadyState> states;  ///< ascending in the first coordinate, then the next
  bool complete{true};              ///< proven: there is no other in the region that was searched
  std::string reason;               ///< why there are none, or not all; or what is free
  std::vector<std::size_t> free;    ///< coordinates of the scene that any value does for
  std::vector<double> momenta;      ///< of the reduction's ignored coordinates, kept
  SteadyProblem problem;
};

/// What a search that is given up is worth: thorough, it goes on where it can be told how far away none is.
enum class SearchEffort { usual, thorough };

/// The state `y` gives the ignored coordinates their momenta and the free ones their values.
/// Thorough. Throws what steady_problem throws.
[[nodiscard]] Equilibria equilibria(const Dynamics& dynamics, const Reals& parameters, const Reals& y);

/// The same for constants of the caller's, such as momenta that stay while a parameter moves.
[[nodiscard]] Equilibria equilibria(const Dynamics& dynamics, const SteadyProblem& problem,
                                    std::span<const double> y, SearchEffort effort = SearchEffort::usual);

/// The places alone, without their stability. Where the forces have charts, all of these are searched.
[[nodiscard]] Equilibria steady_places(const Dynamics& dynamics, const SteadyProblem& problem,
                                       std::span<const double> y, SearchEffort effort = SearchEffort::usual);

}  // namespace qdot
