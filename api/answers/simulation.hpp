#pragma once
// /v1/simulate: a motion as columns.

#include "api/answers/answers.hpp"
#include "api/answers/simulate_request.hpp"
#include "api/contract/request_table.hpp"

namespace qdot::api {

[[nodiscard]] Response answer_simulate(const Resolved<SimulateRequest>& resolved, Call& call, Models& models);

}  // namespace qdot::api
