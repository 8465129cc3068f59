#pragma once
// The smallest values of the scene's `valid_while` quantities along a motion of one coordinate that the
// energy integral describes: does the string stay taut?

#include <functional>

#include "core/turning/turning_points.hpp"

namespace qdot {

/// A closed motion of one coordinate: phase -> (x, x'), one revolution of the phase being all of it.
using PhasePath = std::function<std::pair<double, double>(double phase)>;

/// Sampled at 32 phases, the smallest one refined by parabolas. `momenta`: those of `reduction.ignored`,
/// which give the ignored velocities; `y0` gives the ignored coordinates.
[[nodiscard]] std::vector<ValidityMinimum> validity_minima(const Dynamics& dynamics,
                                                           const Reduction& reduction,
                                                           std::span<const double> parameters,
                                                           std::span<const double> momenta,
                                                           std::span<const double> y0, const PhasePath& path);

}  // namespace qdot
