#pragma once
// /v1/energy: energies, momenta, accelerations and what is conserved, at one state.

#include <optional>

#include "api/answers/endpoint.hpp"

namespace qdot::api {

struct EnergyRequest {
  SystemChoice system{};
  double t{};                   ///< the instant of the state, which forces may depend on [s]
  std::optional<int> digits{};  ///< significant ones of the answer's numbers; none: all of a double
};

[[nodiscard]] const RequestTable<EnergyRequest>& energy_table();

[[nodiscard]] Endpoint energy_endpoint();

}  // namespace qdot::api
