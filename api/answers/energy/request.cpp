#include "api/answers/energy/request.hpp"

#include "api/contract/text_checks.hpp"
#include "api/json/limits.hpp"

namespace qdot::api {

const RequestTable<EnergyRequest>& energy_table() {
  static const RequestTable<EnergyRequest> table(
      {
          system_field<EnergyRequest>(),
          parameters_field<EnergyRequest>(),
          initial_field<EnergyRequest>(),
          inputs_field<EnergyRequest>(),
          number("t", &EnergyRequest::t, {"s", {-limits::largest_time, limits::largest_time}},
                 "instant of the state", {.default_value = 0.0, .aliases = {"time", "t0", "t_start"}}),
          digits_field<EnergyRequest>(),
      },
      {}, [](EnergyRequest& request, Findings& findings) { check_inputs(request.system, findings); });
  return table;
}

}  // namespace qdot::api
