#pragma once
// Where a motion stops because a condition fails, another one may fail before it: within the error of the
// time at which it stops, and within the time that zeros of one step are taken for one instant.
//
// The other condition g may be zero there where it may be at some state that the motion has in that time,
//
//   0 in g(t, y),   |y_k - y_k(stop)| <= e_k + |y_k'(stop)| tau,
//
// by interval arithmetic, with tau that time and e_k the errors of the state [in units of y_k].

#include <string>

#include "core/motion/computed_motion.hpp"
#include "core/motion/measured_simulation.hpp"

namespace qdot {

struct OtherConditions {
  double time{};      ///< tau [s]
  std::string names;  ///< "'p', 'q'"; empty where there are none
};

/// `error`: of the stop. Those with the same `reason` as that stop are left out.
[[nodiscard]] OtherConditions other_conditions_at_stop(const ComputedMotion& motion, const EventError& error);

}  // namespace qdot
