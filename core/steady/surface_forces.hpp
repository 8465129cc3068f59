#pragma once
// The forces at rest on a surface phi(q) = 0 without their multipliers: g = A^T lambda has a solution where
// every determinant of m + 1 rows of (g A^T) vanishes, so that the equilibria are the zeros q of
//
//   det (g_i A_1i ... A_mi), i in S, for each set S of m + 1 coordinates,   and phi_j(q) = 0,
//
// where the constraints do not depend on each other. For each set D of m coordinates those S that hold D are
// enough where D_k = det A_ji, i in D, does not vanish: they are a chart (core/steady/steady_forces.hpp).

#include "core/steady/steady_forces.hpp"
#include "core/steady/surface_statics.hpp"

namespace qdot {

/// In the variables of whole.statics, of which the multipliers are free. `absent`: symbols of momenta that
/// are zero. Throws Error(not_applicable) where there are too many sets.
[[nodiscard]] SteadyForces derive_surface_forces(const SurfaceStatics& whole,
                                                 std::span<const Expression> absent);

/// The sets S, in the order of their determinants in SteadyForces::rest; those of phi_j come after them.
[[nodiscard]] std::vector<std::vector<std::size_t>> sets_of_forces(const SurfaceStatics& whole);

}  // namespace qdot
