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
// From rtol = 1e-14 on the last terms are far below round-off, 1e-18: otherwise what each step cuts off adds
// up always the same way, where the roundings of many steps go to and fro.
//
// Two things keep round-off down. The step is exactly the difference of the two times, h := (t + h) - t; and
// what the sum y + dy rounds away is carried to the next step (Kahan). A step whose polynomial does not obey
// the equation at its end (a kink, a singularity that the coefficients do not show) is taken again, shorter.

#include <memory>

#include "core/integrate/stepper.hpp"

namespace qdot {

/// Needs RightHandSide::expansion. An expansion of order N counts as N evaluations.
[[nodiscard]] std::unique_ptr<Stepper> make_taylor_stepper(const RightHandSide& system,
                                                           const RunRequest& request);

}  // namespace qdot
