#pragma once
// How far from 0 polynomial forces may vanish.
//
// With g_i = sum_d g_id, g_id homogeneous of degree d in x, and r = max |x_k|,
//
//   |g_i(x)| >= r^D (|g_iD(x/r)| - sum_{d < D} r^(d - D) s_id),   D the largest degree of g_i,
//
// where s_id are sums of its coefficients' magnitudes: where for each direction x/r one of the g_iD does not
// vanish, no zero is farther away than some R. Directions are taken as pieces of the faces x_k = 1.

#include <optional>

#include "core/steady/steady_forces.hpp"

namespace qdot {

/// R, a power of two; none where some force is no polynomial in the unknowns, or where no R is found.
[[nodiscard]] std::optional<double> farthest_zero(const SteadyProblem& problem);

}  // namespace qdot
