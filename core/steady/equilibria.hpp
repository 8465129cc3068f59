#pragma once
// All equilibria of a scene: the zeros of the forces g(x) = E(x, 0, 0), one turn of each angle and the whole
// domain of each other coordinate searched by interval arithmetic (core/numerics/root_isolation.hpp), so that
// none is lost and each error is a proven bound. Where coordinates are ignorable, the zeros are steady
// motions with the momenta of a given state (Goldstein, Classical Mechanics, 3rd ed., 8.3): the ignorable
// coordinates move uniformly.
//
// g is searched without its denominators, whose zeros (the axis of a spherical pendulum) are no equilibria.
// Coordinates that no force depends on are free: every value of theirs belongs to an equilibrium.

#include <span>
#include <string>
#include <vector>

#include "core/numerics/root_isolation.hpp"
#include "core/steady/stability.hpp"

namespace qdot {

/// How far out coordinates that are no angles are searched [m]; nothing is claimed beyond.
inline constexpr double largest_length = 1e15;

struct SteadyState {
  std::vector<double> y;       ///< (q, q'): angles in (-pi, pi], ignored coordinates at their steady rates
  std::vector<double> errors;  ///< a proven bound for each component of y
  Box enclosure;               ///< of the coordinates x that are not ignored
  SteadyStability stability;
  double residual{};  ///< largest |g_i| at y [SI]
  /// Proven to be one simple zero. Otherwise a multiple zero,
  /// or several (or none) too close to be told apart.
  bool simple{};
};

struct Equilibria {
  std::vector<SteadyState> states;  ///< ascending in the first coordinate, then the next
  bool complete{true};              ///< proven: there is no other in the region that was searched
  std::string reason;               ///< why there are none, or not all; or what is free
  std::vector<std::size_t> free;    ///< coordinates of the scene that any value does for
  std::vector<double> momenta;      ///< of the reduction's ignored coordinates, kept
  SteadyProblem problem;
};

/// The state `y` gives the ignored coordinates their momenta and the free ones their values.
/// Throws what steady_problem throws.
[[nodiscard]] Equilibria equilibria(const Dynamics& dynamics, std::span<const double> parameters,
                                    std::span<const double> y);

/// The same for constants of the caller's, such as momenta that stay while a parameter moves.
[[nodiscard]] Equilibria equilibria(const Dynamics& dynamics, const SteadyProblem& problem,
                                    std::span<const double> y);

/// One turn of each angle, offset so that no zero is expected at its ends; the domain of each other unknown.
[[nodiscard]] Box search_region(const Model& model, const SteadyProblem& problem);

/// An angle and its enclosure moved by full turns so that it lies in (-pi, pi].
[[nodiscard]] Interval reduced_angle(const Interval& angle);

/// The number inside that is meant: 0 or pi where the interval holds it, else its middle.
[[nodiscard]] double representative(const Interval& x);
/// The largest distance of x from a point of the enclosure.
[[nodiscard]] double distance_bound(double x, const Interval& enclosure);

}  // namespace qdot
