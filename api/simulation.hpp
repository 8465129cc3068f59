#pragma once
// /v1/simulate: a motion as columns.

#include "api/answers.hpp"
#include "api/request_table.hpp"
#include "api/simulate_request.hpp"

namespace qdot::api {

[[nodiscard]] Response answer_simulate(const Resolved<SimulateRequest>& resolved, Call& call, Models& models);

}  // namespace qdot::api
