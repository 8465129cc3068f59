#pragma once
// The problem (RFC 9457) of a run that failed numerically: where it came to, and what to try instead.

#include <span>

#include "api/answers/answers.hpp"
#include "core/integrate/run.hpp"

namespace qdot::api {

/// Whether a run failed numerically, rather than reaching its end or an event of the system.
[[nodiscard]] bool has_failed(Ending ending);

/// The problem of such a run, which came as far as the state y at t. `detail`, where given, replaces the
/// explanation that belongs to the ending.
[[nodiscard]] Response integration_failure(Call& call, const Scene& scene, Ending ending, double t,
                                           std::span<const double> y, const std::string& detail = "");

}  // namespace qdot::api
