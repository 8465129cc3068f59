#pragma once
// Turning points: the largest and the smallest value of a coordinate along a motion.
//
// Where one coordinate x is left after Routh's reduction and h = 1/2 A(x) x'^2 + U(x) stays constant, they
// are the nearest zeros of F(x) = h - U(x) on either side of x0, found without following the motion
// (turning_search.hpp). Otherwise the motion is followed up to a given time
// (core/motion/trajectory_extrema.hpp). Source: Landau, Lifshitz, Mechanics, 3rd ed., section 11 (motion in
// one dimension), and 15.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/dynamics/initial_place.hpp"
#include "core/numerics/finding.hpp"
#include "core/turning/elastic_walls.hpp"
#include "core/turning/energy_problem.hpp"
#include "core/turning/motion_kind.hpp"
#include "core/turning/validity_minimum.hpp"

namespace qdot {

/// The answer of the energy integral.
struct TurningPoints {
  std::size_t coordinate{};  ///< x, by number
  Finding maximum, minimum;
  std::optional<MotionKind> motion;
  std::string motion_reason;  ///< why the kind is not known
  InitialPlace initial{InitialPlace::between};
  std::string stability;                        ///< of an equilibrium: "stable", "unstable" or "neutral"
  Finding energy;                               ///< h [J]
  std::vector<double> momenta, momenta_errors;  ///< p_c of the ignored coordinates
  /// Of a libration: there and back; of a rotation: one turn [s].
  Finding period;
  std::vector<ValidityMinimum> validity;
  std::vector<std::string> notes;
  /// Walls that turn the motion, which ends at them.
  std::optional<ElasticWalls> walls;
  /// The first of the scene's events with an impact that the motion comes to, as far as is known: the energy
  /// integral does not lead beyond it. Empty: it comes to none.
  std::string impact;
};

/// What is found beside the extrema; it costs several times as much.
struct BesideExtrema {
  bool period{true};
  bool along{true};     ///< what happens on the way: validity, and notes on singular places
  bool impacts{false};  ///< whether there is one on the way; nothing else is found then
};

/// By the energy integral, for the one coordinate that is left. y0 = (q, q'). Throws Error(not_applicable)
/// where the energy integral does not answer (why_not_by_energy says so beforehand), and Error(invalid_state)
/// where the initial state has no energy.
[[nodiscard]] TurningPoints turning_points(const Dynamics& dynamics, const Reals& parameters, const Reals& y0,
                                           const BesideExtrema& beside = {});

}  // namespace qdot
