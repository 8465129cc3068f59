#include "api/answers/modes/request.hpp"

#include "api/contract/text_checks.hpp"

namespace qdot::api {

const RequestTable<ModesRequest>& modes_table() {
  static const RequestTable<ModesRequest> table(
      {
          system_field<ModesRequest>(),
          parameters_field<ModesRequest>(),
          symbols_field<ModesRequest>(
              SymbolRole::equilibrium,
              "coordinates of the equilibrium, exact or a guess; without them the stable one downhill of "
              "'initial', where strong damping would bring the system to rest (with one coordinate proven to be "
              "the first place on the way, with more found by short steps), or where there is none the one that "
              "Newton's iteration finds from there; with a constraint in the velocities the steady state that "
              "'initial' is",
              {"about", "at", "around", "position", "steady_state"}),
          initial_field<ModesRequest>(),
          inputs_field<ModesRequest>(),
          digits_field<ModesRequest>(),
      },
      {}, [](ModesRequest& request, Findings& findings) { check_inputs(request.system, findings); });
  return table;
}

}  // namespace qdot::api
