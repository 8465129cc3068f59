#pragma once

#include "api/answers/accuracy_request.hpp"
#include "api/answers/answers.hpp"

namespace qdot::api {

/// The measured trade of error against work: `reference`, `points` (a method at a tolerance: error,
/// evaluations, steps, whether it is on the Pareto front), `recommendations`.
[[nodiscard]] Response answer_accuracy(const Resolved<AccuracyRequest>& resolved, Call& call, Models& models);

}  // namespace qdot::api
