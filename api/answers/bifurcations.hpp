#pragma once
// /v1/bifurcations: where equilibria, or the gaits of a scene with an impact, appear, vanish or change.

#include "api/answers/answers.hpp"
#include "api/answers/bifurcations_request.hpp"
#include "api/contract/request_table.hpp"

namespace qdot::api {

[[nodiscard]] Response answer_bifurcations(const Resolved<BifurcationsRequest>& resolved, Call& call,
                                           Models& models);

}  // namespace qdot::api
