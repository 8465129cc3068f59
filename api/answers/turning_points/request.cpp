#include "api/answers/turning_points/request.hpp"

#include <algorithm>

#include "api/answers/motion_fields.hpp"
#include "api/contract/text_checks.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

using R = TurningPointsRequest;

void check_coordinate(const R& request, Findings& findings) {
  std::vector<std::string> names;
  for (const Coordinate& q : request.system.scene->coordinates) names.push_back(q.name);
  if (request.coordinate.empty() || std::ranges::find(names, request.coordinate) != names.end()) return;
  findings.add(
      unknown_name(findings.root().below("coordinate"),
                   request.system.scene->name + " has no coordinate " + in_quotes(request.coordinate) + ".",
                   request.coordinate, names));
}

void check(R& request, Findings& findings) {
  if (!findings.has_error_at({"t_start", "t_end"}) && request.t_end && *request.t_end <= request.t_start) {
    findings.report("t_end", "out_of_range", "'t_end' must be later than 't_start'.");
  }
  if (!request.system.scene) return;
  if (!findings.has_error_at({"coordinate"})) check_coordinate(request, findings);
  check_inputs(request.system, findings);
  check_impacts(request, findings);
}

}  // namespace

const RequestTable<R>& turning_points_table() {
  static const RequestTable<R> table(
      {
          system_field<R>(),
          parameters_field<R>(),
          initial_field<R>(),
          inputs_field<R>(),
          {detail::bound(
              &R::coordinate,
              detail::info("coordinate", TextKind{limits::name_bytes},
                           "the coordinate whose largest and smallest value you want; it may be left out "
                           "where only one is not ignorable",
                           {.aliases = {"variable", "of", "angle", "q"}}))},
          number("t_start", &R::t_start, {"s", instants}, "instant of the initial state",
                 {.default_value = 0.0, .aliases = {"t0", "tstart", "start"}}),
          number("t_end", &R::t_end, {"s", instants},
                 "up to when the motion is followed, where no energy integral gives the answer",
                 {.aliases = {"tmax", "t_max", "tend", "t_final", "tf", "end", "duration"}}),
          on_invalid_field<R>("what a motion that is followed does where the model stops holding"),
          impacts_field<R>(),
          digits_field<R>(),
      },
      {}, check);
  return table;
}

}  // namespace qdot::api
