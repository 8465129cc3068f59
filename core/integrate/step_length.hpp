#pragma once
// The length of a Taylor step by its last two coefficients that are finite in all components,
//
//   h = min_i min((w_i / |c_i,N-1|)^(1/(N-1)), (w_i / |c_i,N|)^(1/N)),
//
// to some digits. Source: taylor_stepper.hpp.

#include <span>

namespace qdot {

/// `series`: coefficients 0 .. order of each component; `weights`: w_i. Infinite where the coefficients are
/// 0.
[[nodiscard]] double step_length(std::span<const double> series, unsigned order,
                                 std::span<const double> weights);

}  // namespace qdot
