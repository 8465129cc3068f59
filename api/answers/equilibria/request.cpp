#include "api/answers/equilibria/request.hpp"

#include <algorithm>
#include <array>

#include "api/contract/text_checks.hpp"
#include "api/json/limits.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

/// What the answer to `solve_for` says beside the value, which stands under the name of what was solved for.
constexpr std::array fields_of_solution{"system",
                                        "model_version",
                                        "service_version",
                                        "request",
                                        "notes",
                                        "error",
                                        "reason",
                                        "stability",
                                        "nonlinear",
                                        "rate2",
                                        "rate2_error",
                                        "eigenvalues",
                                        "exact",
                                        "exact_rate2",
                                        "all",
                                        "from",
                                        "to",
                                        "from_error",
                                        "to_error",
                                        "ranges",
                                        "ranges_reason",
                                        "units",
                                        "re",
                                        "im",
                                        "from_included",
                                        "to_included"};

/// Parameters and velocities; of the velocities only those of ignorable coordinates can be solved for, which
/// the scene alone does not tell.
void check_unknown(const EquilibriaRequest& request, Findings& findings) {
  std::vector<std::string> allowed;
  for (const Symbol& p : symbols(*request.system.scene, SymbolRole::parameter)) allowed.push_back(p.name);
  for (const Coordinate& q : request.system.scene->coordinates) allowed.push_back(q.name + "_dot");
  if (std::ranges::find(fields_of_solution, *request.solve_for) != fields_of_solution.end()) {
    findings.report("solve_for", "not_applicable",
                    "The answer has a field '" + *request.solve_for +
                        "' already: give the parameter another name in the scene to solve for it.");
    return;
  }
  if (std::ranges::find(allowed, *request.solve_for) != allowed.end()) return;
  FieldError error =
      unknown_name(findings.root().below("solve_for"),
                   "'solve_for' names a parameter or the velocity of an ignorable coordinate; " +
                       in_quotes(*request.solve_for) + " is neither.",
                   *request.solve_for, std::move(allowed));
  error.code = "unknown_symbol";
  findings.add(std::move(error));
}

void check_equilibria(EquilibriaRequest& request, Findings& findings) {
  if (!request.system.scene) return;
  check_inputs(request.system, findings);
  if (request.solve_for) {
    check_unknown(request, findings);
  } else if (!request.system.position.empty() && !findings.has_error_at({"solve_for"})) {
    findings.report(
        "at", "not_applicable",
        "'at' is the position that 'solve_for' is asked for; without it all equilibria are found.");
  }
}

}  // namespace

const RequestTable<EquilibriaRequest>& equilibria_table() {
  static const RequestTable<EquilibriaRequest> table(
      {
          system_field<EquilibriaRequest>(),
          parameters_field<EquilibriaRequest>(),
          initial_field<EquilibriaRequest>(),
          inputs_field<EquilibriaRequest>(),
          {detail::info(
               "solve_for", TextKind{limits::name_bytes},
               "the parameter, or the velocity of an ignorable coordinate, that is to make the position 'at' "
               "an equilibrium",
               {.aliases = {"solve", "unknown", "for", "parameter"}}),
           [](EquilibriaRequest& request, const Json& name) { request.solve_for = name.get<std::string>(); }},
          symbols_field<EquilibriaRequest>(SymbolRole::position, "the position that 'solve_for' is asked for",
                                           {"position", "where", "equilibrium"}),
          digits_field<EquilibriaRequest>(),
      },
      {}, check_equilibria);
  return table;
}

}  // namespace qdot::api
