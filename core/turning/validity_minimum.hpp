#pragma once
// The smallest values of the scene's `valid_while` quantities along a motion of one coordinate that the
// energy integral describes: does the string stay taut?

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/dynamics/dynamics.hpp"
#include "core/turning/enclosed_motion.hpp"
#include "core/turning/phase_path.hpp"

namespace qdot {

/// The smallest value of one of the scene's `valid_while` quantities along the motion.
struct ValidityMinimum {
  std::size_t condition{};  ///< number of the condition in the scene
  std::optional<double> value;
  std::optional<double> error;  ///< proven for the whole motion; none: the least of those looked at
  double x{}, x_dot{};          ///< where the coordinate is then
  std::string reason;           ///< why there is no value
};

/// Sampled at 32 phases of the path, the smallest value refined by parabolas. `momenta`: those of
/// `reduction.ignored`, which give the ignored velocities; `y0` gives the ignored coordinates.
[[nodiscard]] std::vector<ValidityMinimum> validity_minima(const Dynamics& dynamics,
                                                           const Reduction& reduction,
                                                           std::span<const double> parameters,
                                                           std::span<const double> momenta,
                                                           std::span<const double> y0, const PhasePath& path);

/// Of the same along all states of `motion`, whose values are the conditions: none where one of them has no
/// proven least value.
[[nodiscard]] std::vector<ValidityMinimum> proven_minima(EnclosedMotion& motion, std::size_t conditions);

}  // namespace qdot
