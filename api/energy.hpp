#pragma once
// /v1/energy: energies, momenta, accelerations and what is conserved, at one state.

#include "api/answers.hpp"
#include "api/request_table.hpp"
#include "api/state_requests.hpp"

namespace qdot::api {

[[nodiscard]] Response answer_energy(const Resolved<EnergyRequest>& resolved, Call& call, Models& models);

}  // namespace qdot::api
