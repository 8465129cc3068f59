#pragma once
// /v1/equilibria: all equilibria and steady motions with their stability; the number that makes one.

#include "api/answers/answers.hpp"
#include "api/answers/equilibria_request.hpp"
#include "api/contract/request_table.hpp"

namespace qdot::api {

[[nodiscard]] Response answer_equilibria(const Resolved<EquilibriaRequest>& resolved, Call& call,
                                         Models& models);

}  // namespace qdot::api
