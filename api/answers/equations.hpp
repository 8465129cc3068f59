#pragma once
// /v1/equations: everything that is derived from a scene, written out in one of six notations.

#include "api/answers/answers.hpp"
#include "api/answers/state_requests.hpp"
#include "api/contract/request_table.hpp"

namespace qdot::api {

[[nodiscard]] Response answer_equations(const Resolved<EquationsRequest>& resolved, Call& call,
                                        Models& models);

}  // namespace qdot::api
