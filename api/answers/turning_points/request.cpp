#include "api/answers/turning_points/request.hpp"

#include <algorithm>

#include "api/answers/motion_fields.hpp"
#include "api/contract/text_checks.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

void check_coordinate(const TurningPointsRequest& request, Findings& findings) {
  std::vector<std::string> names;
  for (const Coordinate& q : request.system.scene->coordinates) names.push_back(q.name);
  if (request.coordinate.empty() || std::ranges::find(names, request.coordinate) != names.end()) return;
  findings.add(
      unknown_name(findings.root().below("coordinate"),
                   request.system.scene->name + " has no coordinate " + in_quotes(request.coordinate) + ".",
                   request.coordinate, names));
}

void check_turning_points(TurningPointsRequest& request, Findings& findings) {
  if (!findings.has_error_at({"t_start", "t_end"}) && request.t_end && *request.t_end <= request.t_start) {
    findings.report("t_end", "out_of_range", "'t_end' must be later than 't_start'.");
  }
  request.start = findings.exact("t_start", request.t_start);
  if (request.t_end) request.end = findings.exact("t_end", *request.t_end);
  if (!request.system.scene) return;
  if (!findings.has_error_at({"coordinate"})) check_coordinate(request, findings);
  check_inputs(request.system, findings);
  check_impacts(request, findings);
}

}  // namespace

const RequestTable<TurningPointsRequest>& turning_points_table() {
  static const RequestTable<TurningPointsRequest> table(
      {
          system_field<TurningPointsRequest>(),
          parameters_field<TurningPointsRequest>(),
          initial_field<TurningPointsRequest>(),
          inputs_field<TurningPointsRequest>(),
          {detail::bound(
              &TurningPointsRequest::coordinate,
              detail::info("coordinate", TextKind{limits::name_bytes},
                           "the coordinate whose largest and smallest value you want; it may be left out "
                           "where only one is not ignorable",
                           {.aliases = {"variable", "of", "angle", "q"}}))},
          number("t_start", &TurningPointsRequest::t_start, {"s", instants}, "instant of the initial state",
                 {.default_value = 0.0, .aliases = {"t0", "tstart", "start"}}),
          number("t_end", &TurningPointsRequest::t_end, {"s", instants},
                 "up to when the motion is followed, where no energy integral gives the answer",
                 {.aliases = {"t", "time", "tmax", "t_max", "tend", "t_final", "tf", "end", "duration"}}),
          on_invalid_field<TurningPointsRequest>(
              "what a motion that is followed does where the model stops holding"),
          impacts_field<TurningPointsRequest>(),
          digits_field<TurningPointsRequest>(),
      },
      {}, check_turning_points);
  return table;
}

}  // namespace qdot::api
