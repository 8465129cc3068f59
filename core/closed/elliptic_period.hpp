#pragma once
// Periods by the complete elliptic integral K(m) of du/sqrt(1 - m sin(u)^2) from 0 to pi/2: of a pendulum
//
//   A x'^2/2 - B cos(n x - x0) = h,   n = 1 or 2,   d = h + B its height above the lowest place
//   T = 4/n sqrt(A/B) K(d/(2 B))       where it swings,
//   T = 2 sqrt(2 A/d) K(2 B/d)         for a turn of 2 pi where it goes over the top,
//
// and of Duffing's oscillator, A x'^2/2 + a x^2/2 + b x^4/4 = h, with s^2 = a^2 + 4 b h:
//
//   T = 4 sqrt(A/s) K((1 - a/s)/2)               b > 0, through x = 0
//   T = 2 sqrt(2 A/(s - a)) K(2 s/(s - a))       a < 0 < b, in one of two wells
//   T = 4 sqrt(2 A/(a + s)) K((a - s)/(a + s))   b < 0 < a
//
// Landau, Lifshitz, Mechanics, 3rd ed., section 11, problem 1; Whittaker, Analytical Dynamics, 4th ed.,
// section 44; Nayfeh, Mook, Nonlinear Oscillations, 2.1.

#include <vector>

#include "core/closed/elementary_period.hpp"
#include "core/turning/motion_kind.hpp"

namespace qdot {

/// factor K(m).
struct EllipticPeriod {
  Expression factor, m;
};

/// Among these the period is, where it is one of those; each has to be held against the number.
[[nodiscard]] std::vector<EllipticPeriod> elliptic_periods(const QuadratureProblem& problem,
                                                           const ExactValues& values, MotionKind motion);

}  // namespace qdot
