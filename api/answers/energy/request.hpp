#pragma once
// /v1/energy: energies, momenta, accelerations and what is conserved, at one state.

#include <optional>

#include "api/answers/endpoint.hpp"

namespace qdot::api {

struct EnergyRequest {
  SystemChoice system{};
  double t{};
  std::optional<int> digits{};
};

[[nodiscard]] const RequestTable<EnergyRequest>& energy_table();

[[nodiscard]] Endpoint energy_endpoint();

}  // namespace qdot::api
