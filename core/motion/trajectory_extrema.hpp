#pragma once
// The largest and the smallest value of a coordinate along a motion that is followed: where its velocity
// changes sign (found to round-off on the dense output), at both ends, and on both sides of impacts.

#include "core/dynamics/initial_place.hpp"
#include "core/motion/simulation.hpp"
#include "core/numerics/finding.hpp"

namespace qdot {

struct ExtremaRequest {
  Reals parameters;
  Reals y_start;  ///< q, then q'
  std::size_t coordinate{};
  double t_start{};
  double t_end{};
  double t_start_left_out{}, t_end_left_out{};  ///< what these leave out of the instants that were typed
  OnInvalid on_invalid{OnInvalid::stop};
  Impacts impacts{Impacts::apply};
  Limits limits;
};

struct TrajectoryExtrema {
  Finding maximum, minimum;
  double t_maximum{}, t_minimum{};
  std::optional<double> t_maximum_error{}, t_minimum_error{};  ///< where they are known
  InitialPlace initial{InitialPlace::between};
  std::optional<Stop> stop;
  Ending ending{Ending::reached_end};
  double t{};  ///< how far the motion was followed
  std::vector<double> y;
};

/// The motion is followed with its measured error at each place (ladder.hpp); an extremum is off by that, and
/// by what the coordinate goes in the time by which the place is. Where errors grow it is followed once more
/// only up to the extremum. No value where the error could not be measured. Throws what simulate throws.
[[nodiscard]] TrajectoryExtrema trajectory_extrema(const Dynamics& dynamics, const ExtremaRequest& request);

}  // namespace qdot
