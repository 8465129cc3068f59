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
  InitialPlace initial{InitialPlace::between};
  std::optional<Stop> stop;
  Ending ending{Ending::reached_end};
  double t{};  ///< how far the motion was followed
  std::vector<double> y;
};

/// The motion is integrated twice, by two methods with tolerances a hundred times apart; what the extrema
/// differ by is the error stated. One begins at the instant that was typed, the other one at t_start, so that
/// what the motion makes of the rounding is in that error; and what it makes of the rounding of the other
/// numbers that were typed, where these are no doubles, a third integration tells. Throws what simulate
/// throws.
[[nodiscard]] TrajectoryExtrema trajectory_extrema(const Dynamics& dynamics, const ExtremaRequest& request);

}  // namespace qdot
