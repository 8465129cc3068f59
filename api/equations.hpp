#pragma once
// /v1/equations: everything that is derived from a scene, written out in one of six notations.

#include "api/answers.hpp"
#include "api/request_table.hpp"
#include "api/state_requests.hpp"

namespace qdot::api {

[[nodiscard]] Response answer_equations(const Resolved<EquationsRequest>& resolved, Call& call,
                                        Models& models);

}  // namespace qdot::api
