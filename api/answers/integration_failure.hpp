#pragma once
// Runs that ended in their numbers, as problems.

#include <span>

#include "api/answers/answers.hpp"
#include "core/integrate/run.hpp"

namespace qdot::api {

/// Whether a run ended in its numbers and not in the nature of the system.
[[nodiscard]] bool has_failed(Ending ending);
/// The problem of such a run, which came as far as the state y at t. `detail` says it better than the ending
/// alone can.
[[nodiscard]] Response integration_failure(Call& call, const Scene& scene, Ending ending, double t,
                                           std::span<const double> y, const std::string& detail = "");

}  // namespace qdot::api
