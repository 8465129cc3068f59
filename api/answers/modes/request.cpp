#include "api/answers/modes/request.hpp"

#include "api/contract/text_checks.hpp"

namespace qdot::api {

const RequestTable<ModesRequest>& modes_table() {
  using R = ModesRequest;
  static const RequestTable<R> table(
      {
          system_field<R>(),
          parameters_field<R>(),
          symbols_field<R>(SymbolRole::equilibrium,
                           "coordinates of the equilibrium, exact or a guess; without them the stable one "
                           "nearest to 'initial'",
                           {"about", "at", "around", "position", "steady_state"}),
          initial_field<R>(),
          inputs_field<R>(),
          digits_field<R>(),
      },
      {}, [](R& request, Findings& findings) { check_inputs(request.system, findings); });
  return table;
}

}  // namespace qdot::api
