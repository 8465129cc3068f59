#pragma once
// /v1/turning_points: the largest and the smallest value of a coordinate along a motion.

#include "api/answers.hpp"
#include "api/request_table.hpp"
#include "api/turning_points_request.hpp"

namespace qdot::api {

[[nodiscard]] Response answer_turning_points(const Resolved<TurningPointsRequest>& resolved, Call& call,
                                             Models& models);

}  // namespace qdot::api
