#pragma once
// A motion to more digits than doubles have, with its error: a run in double-doubles, and others that differ
// from it in order, tolerance and the last bits of their parameters and initial values.
//
// As in the ladder (ladder.hpp), twice the largest difference is the error of the first run. What the numbers
// of the request are uncertain by, such as what was computed from other parameters, is in the others' starts.

#include <optional>
#include <string>
#include <vector>

#include "core/motion/extended_motion.hpp"

namespace qdot {

struct ExtendedSimulationRequest {
  Reals parameters;  ///< all of them, in order
  Reals y_start;     ///< q, then q'
  Real t_start;
  Reals grid;                       ///< increasing, from t_start on
  std::optional<double> max_error;  ///< wanted, in every column's SI unit; none: the least there is
  Limits limits;
};

struct ExtendedSimulation {
  ExtendedRun run;
  double rtol{};
  std::vector<double> max_abs_error;   ///< of each coordinate and velocity; empty where it was not measured
  std::optional<std::size_t> horizon;  ///< the first row where it passes 1e-3 of a column's scale
  std::optional<bool> meets_request;   ///< no value where no error was wanted
  std::string reason;                  ///< why the error is not known, or not met
  /// Every step of every run has a bound of what it hides.
  bool bounded{false};
  std::uint64_t evaluations{};  ///< of all runs
};

/// Needs accelerations that have a Taylor expansion. The smooth motion, as extended_states has it.
[[nodiscard]] ExtendedSimulation extended_simulation(const Dynamics& dynamics,
                                                     const ExtendedSimulationRequest& request);

}  // namespace qdot
