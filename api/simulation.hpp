#pragma once
// /v1/simulate: a motion as columns.

#include "api/answers.hpp"
#include "api/request_table.hpp"
#include "api/simulate_request.hpp"
#include "core/integrate/run.hpp"

namespace qdot::api {

/// Whether a run ended in its numbers and not in the nature of the system.
[[nodiscard]] bool has_failed(Ending ending);
/// The problem of such a run, which came as far as the state y at t.
[[nodiscard]] Response integration_failure(Call& call, const Scene& scene, Ending ending, double t,
                                           std::span<const double> y);

[[nodiscard]] Response answer_simulate(const Resolved<SimulateRequest>& resolved, Call& call, Models& models);

}  // namespace qdot::api
