#pragma once
// Bodies of negative mass. A hole in a plate is one: the plate with it still weighs something. What weighs
// less than nothing moves as nothing does, towards higher energies, and is a slip of the pen.

#include <vector>

#include "core/mechanics/lagrangian.hpp"

namespace qdot {

/// What is wrong with the inertia of a scene's bodies, by the domains of its parameters and coordinates:
///   a moment of inertia below zero, of a body whose mass is not, or three that are those of no body;
///   a mass below zero that nothing outweighs: a coordinate that moves alone has M_ii <= 0.
/// Constraints may hold what is negative to what is not, so that of scenes with them only the first is known.
[[nodiscard]] std::vector<Diagnostic> negative_inertia(const Scene& scene, const ParsedScene& parsed,
                                                       const Lagrangian& lagrangian);

}  // namespace qdot
