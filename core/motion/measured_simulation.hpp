#pragma once
// A motion and what is known of its error.

#include <optional>
#include <string>
#include <vector>

#include "core/motion/events_in_doubt.hpp"
#include "core/motion/simulation.hpp"

namespace qdot {

/// How far an event may be from that of the true motion.
struct EventError {
  double time{};              ///< in s
  std::vector<double> state;  ///< of each component; empty where that is not known
  /// Whether it is one crossing: in that time its function may also turn, and cross zero three times or more.
  bool is_single{true};
};

struct MeasuredSimulation {
  Simulation simulation;
  Tolerances tolerances;  ///< of the run that is returned; not of a fixed step
  /// Of each coordinate and velocity, over the returned rows; empty when it could not be measured: `reason`.
  std::vector<double> max_abs_error;
  /// Of the events and of the stop; no value where the motion grazes, or beyond the last row.
  std::vector<std::optional<EventError>> event_errors;
  std::optional<EventError> stop_error;
  /// The returned instants that are at an impact to within its error: their rows are on one side of it, and
  /// whether the motion is there is not known.
  std::vector<double> at_impacts;
  /// The first returned instant where the error passes 1e-3 of a column's largest magnitude.
  std::optional<double> horizon;
  std::optional<bool> meets_request;  ///< no value where no error was wanted
  std::string reason;                 ///< why the error is not known, or not met
  EventsInDoubt events_in_doubt;
  /// Whether nothing lies hidden between the places that the computations looked at: every step of all of
  /// them has a bound of its defect. An error without it is what the places looked at say.
  bool bounded{false};
  Method verified_by{};
  std::uint64_t evaluations{};  ///< of all runs
};

}  // namespace qdot
