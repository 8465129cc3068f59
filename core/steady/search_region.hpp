#pragma once
// Where equilibria are looked for, and how an enclosure becomes a number with an error.

#include "core/base/short_number.hpp"
#include "core/numerics/root_isolation.hpp"
#include "core/steady/steady_forces.hpp"

namespace qdot {

/// How far out coordinates that are no angles are searched [m]; nothing is claimed beyond.
inline constexpr double largest_length = 1e15;

/// One turn of each angle, offset so that no zero is expected at its ends; the domain of each other
/// coordinate. `unknowns`: places in x.
[[nodiscard]] Box search_region(const Model& model, const SteadyProblem& problem,
                                std::span<const std::size_t> unknowns);
/// Of the forces' unknowns.
[[nodiscard]] Box search_region(const Model& model, const SteadyProblem& problem);

/// An angle and its enclosure moved by full turns so that it lies in (-pi, pi].
[[nodiscard]] Interval reduced_angle(const Interval& angle);

/// The number inside that is meant: 0 or pi where the interval holds it, else its middle.
[[nodiscard]] double representative(const Interval& x);
/// The largest distance of x from a point of the enclosure.
[[nodiscard]] double distance_bound(double x, const Interval& enclosure);

}  // namespace qdot
