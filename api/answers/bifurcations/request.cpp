#include "api/answers/bifurcations/request.hpp"

#include <algorithm>
#include <array>

#include "api/contract/text_checks.hpp"
#include "api/json/limits.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

/// What a branch and a critical value have beside the columns of the parameter and of the coordinates.
constexpr std::array fields_of_branches{"id", "kind", "stability", "step_time", "value", "error"};

void check_columns(const BifurcationsRequest& request, Findings& findings) {
  std::vector<std::string> columns{request.parameter};
  for (const Coordinate& q : request.system.scene->coordinates) columns.push_back(q.name);
  for (const std::string& column : columns) {
    if (std::ranges::find(fields_of_branches, column) == fields_of_branches.end()) continue;
    findings.report("parameter", "not_applicable",
                    "The answer's branches have a column '" + column +
                        "' already: give what the scene calls so another name to ask for them.");
  }
}

void check_bifurcations(BifurcationsRequest& request, Findings& findings) {
  if (!request.system.scene) return;
  check_inputs(request.system, findings);
  if (findings.has_error_at({"parameter"})) return;
  std::vector<std::string> allowed;
  for (const Symbol& p : symbols(*request.system.scene, SymbolRole::parameter)) allowed.push_back(p.name);
  if (std::ranges::find(allowed, request.parameter) == allowed.end()) {
    FieldError error =
        unknown_name(findings.root().below("parameter"),
                     request.system.scene->name + " has no parameter " + in_quotes(request.parameter) + ".",
                     request.parameter, std::move(allowed));
    error.code = "unknown_symbol";
    findings.add(std::move(error));
  } else if (!findings.has_error_at({"from", "to"}) && !(request.from < request.to)) {
    findings.report("to", "out_of_range", "'to' must be larger than 'from'.");
  } else {
    check_columns(request, findings);
  }
}

}  // namespace

const RequestTable<BifurcationsRequest>& bifurcations_table() {
  static const RequestTable<BifurcationsRequest> table(
      {
          system_field<BifurcationsRequest>(),
          parameters_field<BifurcationsRequest>(),
          initial_field<BifurcationsRequest>(),
          inputs_field<BifurcationsRequest>(),
          {detail::info("parameter", TextKind{limits::name_bytes}, "the parameter that moves",
                        {.need = Need::required, .aliases = {"control", "vary", "sweep", "lambda"}}),
           [](BifurcationsRequest& request, const Json& name) {
             request.parameter = name.get<std::string>();
           }},
          parameter_value("from", &BifurcationsRequest::from, "parameter",
                          "its first value, in the unit of the parameter",
                          {.need = Need::required, .aliases = {"start", "min", "lower"}}),
          parameter_value("to", &BifurcationsRequest::to, "parameter", "its last value",
                          {.need = Need::required, .aliases = {"end", "stop", "max", "upper"}}),
          digits_field<BifurcationsRequest>(),
      },
      {}, check_bifurcations);
  return table;
}

}  // namespace qdot::api
