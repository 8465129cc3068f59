#pragma once
// The smallest values of the scene's `valid_while` quantities along a motion of one coordinate that the
// energy integral describes: does the string stay taut?

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/dynamics/dynamics.hpp"

namespace qdot {

/// The smallest value of one of the scene's `valid_while` quantities along the motion.
struct ValidityMinimum {
  std::size_t condition{};  ///< number of the condition in the scene
  std::optional<double> value;
  double x{}, x_dot{};  ///< where the coordinate is then
  std::string reason;   ///< why there is no value
};

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
