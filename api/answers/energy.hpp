#pragma once
// /v1/energy: energies, momenta, accelerations and what is conserved, at one state.

#include "api/answers/answers.hpp"
#include "api/answers/state_requests.hpp"
#include "api/contract/request_table.hpp"

namespace qdot::api {

[[nodiscard]] Response answer_energy(const Resolved<EnergyRequest>& resolved, Call& call, Models& models);

}  // namespace qdot::api
