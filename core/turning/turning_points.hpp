#pragma once
// Turning points: the largest and the smallest value of a coordinate along a motion.
//
// Where one coordinate x is left after Routh's reduction and h = 1/2 A(x) x'^2 + U(x) stays constant, they
// are the nearest zeros of F(x) = h - U(x) on either side of x0, found without following the motion
// (turning_search.hpp). Otherwise the motion is followed up to a given time (trajectory_extrema.hpp).
// Source: Landau, Lifshitz, Mechanics, 3rd ed., section 11 (motion in one dimension), and 15.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/dynamics/initial_place.hpp"
#include "core/numerics/finding.hpp"
#include "core/turning/validity_minimum.hpp"

namespace qdot {

/// libration: to and fro between two turning points. rotation: an angle that never turns. separatrix: the
/// energy is that of a maximum of U, as far as numbers can tell. unbounded: it never turns on one side.
enum class MotionKind { libration, rotation, separatrix, equilibrium, unbounded };

/// The answer of the energy integral.
struct TurningPoints {
  std::size_t coordinate{};  ///< x, by number
  Finding maximum, minimum;
  std::optional<MotionKind> motion;
  std::string motion_reason;  ///< why the kind is not known
  InitialPlace initial{InitialPlace::between};
  std::string stability;        ///< of an equilibrium: "stable", "unstable" or "neutral"
  Finding energy;               ///< h [J]
  std::vector<double> momenta;  ///< p_c of the ignored coordinates
  /// Of a libration: there and back; of a rotation: one turn [s].
  Finding period;
  std::vector<ValidityMinimum> validity;
  std::vector<std::string> notes;
};

/// Empty where the energy integral answers for `coordinate`; else a sentence why it does not.
[[nodiscard]] std::string why_not_by_energy(const Dynamics& dynamics, std::span<const double> parameters,
                                            std::size_t coordinate);

/// By the energy integral, for the one coordinate that is left. y0 = (q, q'). Throws Error(invalid_state)
/// where the initial state has no energy.
[[nodiscard]] TurningPoints turning_points(const Dynamics& dynamics, std::span<const double> parameters,
                                           std::span<const double> y0);

}  // namespace qdot
