#pragma once
// Where a motion stops because a condition fails, another one may fail before it: within the error of the
// time at which it stops, and within the time that zeros of one step are taken for one instant.
//
// The other condition g may be zero there where it may be at some state that the motion has in that time,
//
//   0 in g(t, y),   |t - t(stop)| <= tau,   |y_k - y_k(stop)| <= e_k + |y_k'(stop)| tau,
//
// by interval arithmetic over that box, with tau that time [s] and e_k the errors of the state [in units of
// y_k]. The box is an estimate: the errors are, and rates are taken for constant in so short a time.
// Source of the range over a box: Moore, Kearfott, Cloud, Introduction to Interval Analysis (2009),
// chapter 5.

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
