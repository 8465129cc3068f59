#pragma once
// One small motion u(t) = Re(shape e^(s t)), s = rate + i omega, about an equilibrium or steady motion
// (core/steady/modes.hpp has the equations).

#include <complex>
#include <optional>
#include <vector>

namespace qdot {

enum class ModeKind {
  rigid,        ///< nothing drives u back anywhere along the shape: omega = 0
  neutral,      ///< omega = 0 to within the rounding of the parameters: linearization does not decide
  growth,       ///< as e^(rate t); in an undamped system its mirror image e^(-rate t) goes with it
  decay,        ///< as e^(-rate t)
  oscillation,  ///< cos(omega t), undamped
};
[[nodiscard]] const char* name(ModeKind kind);

struct Mode {
  ModeKind kind{};
  double omega{};                     ///< [rad/s]; 0 where nothing oscillates
  double rate{};                      ///< of growth or decay [1/s], positive
  std::optional<double> lambda;       ///< -s^2 where that is real: omega^2, or -rate^2 [1/s^2]
  std::optional<double> omega_error;  ///< bound; none where it could not be proven
  /// Also of an oscillation whose rate of growth or decay is zero only to within it.
  std::optional<double> rate_error;
  /// In the coordinates' own units, all of the scene's coordinates in order; its first component that is not
  /// zero is 1. What is zero to within its error is exactly zero.
  std::vector<std::complex<double>> shape;
  std::vector<double> shape_error;  ///< bound for each component; none where it could not be proven
  /// So many modes have this omega to within the rounding of the parameters: any combination of their shapes
  /// is a shape.
  std::size_t multiplicity{1};
};

}  // namespace qdot
