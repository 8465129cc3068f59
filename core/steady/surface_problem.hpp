#pragma once
// A scene on the surface of its constraints with its numbers: its forces without multipliers
// (core/steady/surface_forces.hpp), ready for a search of all their zeros.

#include "core/steady/surface_forces.hpp"

namespace qdot {

struct SurfaceProblem {
  SurfaceStatics whole;
  SteadyProblem steady;         ///< its statics are whole.statics
  std::vector<Ball> constants;  ///< the same as steady.constants
  std::vector<double> y;        ///< of whole.dynamics: where ignorable and free coordinates are
};

/// The state y = (q, q') gives the ignorable coordinates their momenta. Throws what surface_statics and
/// derive_surface_forces throw, and Error(not_applicable) with dry friction.
[[nodiscard]] SurfaceProblem surface_problem(const Dynamics& dynamics, const Reals& parameters,
                                             const Reals& y);

}  // namespace qdot
