#pragma once
// GET and POST /v1/gait.

#include "api/answers/answers.hpp"
#include "api/answers/gait_request.hpp"

namespace qdot::api {

[[nodiscard]] Response answer_gait(const Resolved<GaitRequest>& resolved, Call& call, Models& models);

}  // namespace qdot::api
