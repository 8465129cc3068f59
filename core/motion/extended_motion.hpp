#pragma once
// A motion in double-doubles, from parameters, initial values and instants that have twice the digits of
// doubles: the decimals that were typed, not the doubles next to them.
//
// In mixed form it costs two to three runs in doubles and measures what rounding did to one of them. In full
// it has some 30 digits beside the motion's own amplification of errors.

#include "core/dynamics/dynamics.hpp"
#include "core/integrate/extended_run.hpp"
#include "core/numerics/real.hpp"

namespace qdot {

struct ExtendedMotionRequest {
  enum class Form {
    mixed,  ///< the higher Taylor coefficients in doubles (MixedExpansion::first_in_doubles)
    full
  };
  std::vector<DoubleDouble> parameters;  ///< all of them, in order
  std::vector<DoubleDouble> y_start;     ///< q, then q'
  std::vector<double> apart{};           ///< as in ExtendedRunRequest
  DoubleDouble t_start;
  std::vector<DoubleDouble> grid;  ///< increasing, from t_start on; the motion ends with it
  Form form{Form::mixed};
  double rtol{};  ///< of a step; 0: round-off of the form
  double atol_over_rtol{1e-3};
  unsigned taylor_order{};      ///< 0: by the tolerance
  bool look_for_hidden{false};  ///< bound what lies between the places that are looked at
  bool follow_rounding{false};  ///< and what rounding inside of forces makes of the motion
  Limits limits;
};

/// As they were typed.
[[nodiscard]] std::vector<DoubleDouble> double_doubles(const Reals& numbers);

/// In mixed form, from numbers as they were typed.
[[nodiscard]] ExtendedMotionRequest extended_request(const Reals& parameters, const Reals& y_start,
                                                     double t_start, std::span<const double> grid);

/// The equations in that form. Keeps a reference to the tape alone.
[[nodiscard]] ExtendedSystem extended_system(const CompiledFunction& accelerations,
                                             const ExtendedMotionRequest& request);

/// The states on the grid. The motion is the smooth one: no event, no impact and no condition of validity is
/// looked at. Needs accelerations that have a Taylor expansion (has_extended_expansion).
[[nodiscard]] ExtendedRun extended_states(const Dynamics& dynamics, const ExtendedMotionRequest& request);

/// The same with a system that is there.
[[nodiscard]] ExtendedRun extended_states(const ExtendedSystem& system, const ExtendedMotionRequest& request);

}  // namespace qdot
