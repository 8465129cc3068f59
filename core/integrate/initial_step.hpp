#pragma once
// The length of the first step of a run, found from the equations alone.

#include <optional>
#include <span>

#include "core/integrate/evaluator.hpp"
#include "core/integrate/run.hpp"

namespace qdot {

/// A first step h for a method whose local error is of order h^(order + 1), such that an explicit Euler step
/// is small and 0.01 = h^(order+1) max(|y'|, |y''|), all in the norm max_i |v_i| / (atol + rtol |y_i|). Two
/// evaluations. At most the span t_end - t; empty if f has no value at (t, y) (the evaluator knows why).
/// Source: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, 2nd ed., II.4, "Starting Step
/// Size" (with the maximum norm, which cannot overflow,
/// and a share of the span where they use absolute times).
[[nodiscard]] std::optional<double> initial_step(Evaluator& evaluator, double t, std::span<const double> y,
                                                 double t_end, const Tolerances& tolerances, int order);

}  // namespace qdot
