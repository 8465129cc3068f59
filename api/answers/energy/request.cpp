#include "api/answers/energy/request.hpp"

#include "api/contract/text_checks.hpp"
#include "api/json/limits.hpp"

namespace qdot::api {

const RequestTable<EnergyRequest>& energy_table() {
  using R = EnergyRequest;
  static const RequestTable<R> table(
      {
          system_field<R>(),
          parameters_field<R>(),
          initial_field<R>(),
          inputs_field<R>(),
          number("t", &R::t, {"s", {-limits::largest_time, limits::largest_time}}, "instant of the state",
                 {.default_value = 0.0, .aliases = {"time", "t0", "t_start"}}),
          digits_field<R>(),
      },
      {}, [](R& request, Findings& findings) { check_inputs(request.system, findings); });
  return table;
}

}  // namespace qdot::api
