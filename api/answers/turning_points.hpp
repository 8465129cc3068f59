#pragma once
// /v1/turning_points: the largest and the smallest value of a coordinate along a motion.

#include "api/answers/answers.hpp"
#include "api/answers/turning_points_request.hpp"
#include "api/contract/request_table.hpp"

namespace qdot::api {

[[nodiscard]] Response answer_turning_points(const Resolved<TurningPointsRequest>& resolved, Call& call,
                                             Models& models);

}  // namespace qdot::api
