#pragma once
// Gauss's collocation method (gauss_stages.hpp) with a fixed step.
//
// Steps end at t_start + k h, each rounded once, and the last at t_end: it is shorter where h does not divide
// the span, so that a longer motion begins with the very steps of a shorter one. The step is exactly the
// difference of the two times; what the sum z + dz rounds away is carried to the next step (Kahan).
//
// Variables are the canonical z = (q, p) where the system has them; y = (q, q') is converted to z once at the
// start and z to y at what is looked at. Dense output is a step of the same method to the place, from the
// beginning of the step around it: order 6 as at the steps, three evaluations an iteration. The start values
// of a step come from the slopes of the last one.

#include <memory>

#include "core/integrate/stepper.hpp"

namespace qdot {

/// Uses RightHandSide::canonical, or `derivative` and,
/// where the fixed-point iteration does not contract, `jacobian`.
[[nodiscard]] std::unique_ptr<Stepper> make_gauss_stepper(const RightHandSide& system,
                                                          const RunRequest& request);

}  // namespace qdot
