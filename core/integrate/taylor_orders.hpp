#pragma once
// The order p of Taylor's method for a relative tolerance, and what its steps are held to. The terms of a
// step as long as
//
//   h = min_i (w_i / |c_i,p|)^(1/p)      w_i: taylor_stepper.hpp
//
// end at the tolerance. Counting products alone, p = 1 - ln(rtol)/2 would be best, 8 at 1e-6; bounds, events
// and rows cost by the step, so that longer ones pay. Between 8 and 24 no p is best for all motions: what one
// gains, a fifth, another loses.
// Source: Jorba, Zou, Experimental Mathematics 14 (2005) 99, section 3.1.

#include "core/integrate/run.hpp"

namespace qdot {

inline constexpr double round_off_wanted = 1e-14;  ///< rtol from which on truncation is kept below round-off

/// What steps are held to.
[[nodiscard]] inline double relative_tolerance(const RunRequest& request) {
  constexpr double below_round_off = 1e-18;
  const double rtol = request.tolerances.rtol;
  return request.taylor_order == 0 && rtol <= round_off_wanted ? below_round_off : rtol;
}

/// That of the request, where it names one.
[[nodiscard]] inline unsigned order_for(const RunRequest& request) {
  constexpr unsigned order_loose = 16, order_tight = 20, order_at_round_off = 24;
  constexpr double loose = 1e-6;
  if (request.taylor_order > 0) return request.taylor_order;
  if (request.tolerances.rtol <= round_off_wanted) return order_at_round_off;
  return request.tolerances.rtol >= loose ? order_loose : order_tight;
}

}  // namespace qdot
