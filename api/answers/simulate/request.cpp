#include "api/answers/simulate/request.hpp"

#include <algorithm>

#include "api/answers/bounds.hpp"
#include "api/answers/motion_fields.hpp"
#include "api/answers/simulate/extended_number.hpp"
#include "api/contract/text_checks.hpp"
#include "core/integrate/run.hpp"

namespace qdot::api {
namespace {

/// Whether only a number of impacts was asked for. The grid then ends with the last of them, and only the
/// motion tells when that is.
bool has_open_end(const SimulateRequest& request) {
  return request.steps && !request.t_end && request.times.empty();
}

void check_grid(SimulateRequest& request, Findings& findings) {
  if (has_open_end(request)) return;
  read_grid(request, column_count(*request.system.scene, request.include), findings);
}

constexpr int most_digits_of_doubles = 17;
constexpr double least_extended_error = 1e-24;

void check_step(const SimulateRequest& request, Findings& findings) {
  const MethodRecord& method = record_of(request.method);
  const bool is_fixed = method.has_fixed_step();
  if (is_fixed && !request.h && !findings.has_error_at({"h"})) {
    findings.report("h", "missing",
                    "'h' is missing: method " + std::string(method.name) +
                        " steps by a fixed h, in place of tolerances or a wanted error.");
  }
  if (!request.h) return;
  if (!is_fixed && !findings.has_error_at({"method"})) {
    findings.report(
        "h", "not_applicable",
        "'h' is the step of method " + methods_of_fixed_step() + "; other methods choose their own.");
  }
  const auto most = static_cast<double>(limits_of_run().max_steps);
  if (is_fixed && request.t_end && (*request.t_end - request.t_start) / *request.h > most) {
    findings.report("h", "too_many",
                    "Steps of this length are too many: a motion may take " +
                        std::to_string(limits_of_run().max_steps) + ".");
  }
}

/// The default of atol must not undo a very small rtol.
void complete_tolerances(SimulateRequest& request, Findings& findings) {
  if (!findings.is_defaulted("atol")) return;
  request.atol = std::min(request.atol, 1e-3 * request.rtol);
  findings.echo()["atol"] = request.atol;
}

/// Reports the fields that extended precision cannot honour.
void check_extended(const SimulateRequest& request, Findings& findings) {
  const auto refuse = [&](const char* field, bool is_given, const std::string& why) {
    if (is_given) findings.report(field, "not_applicable", why);
  };
  const std::string only =
      "' does not go with precision extended, where max_error is the error that is asked for.";
  const bool is_wanted_otherwise = request.accuracy || request.max_evaluations;
  refuse(request.accuracy ? "accuracy" : "max_evaluations", is_wanted_otherwise,
         std::string("'") + (request.accuracy ? "accuracy" : "max_evaluations") + only);
  for (const char* field : {"rtol", "atol"}) {
    refuse(field, findings.echo().contains(field) && !findings.is_defaulted(field),
           std::string("'") + field + only);
  }
  refuse("h", request.h.has_value(), std::string("'h") + only);
  refuse("method", request.method != Method::taylor, "Extended precision has one method: taylor.");
  refuse("verify", !request.verify, "In extended precision the error is always measured.");
  refuse("events", !request.events.empty(), "Events are located in double precision only.");
  refuse("steps", request.steps.has_value(), "Strides are followed in double precision only.");
  const Scene* scene = request.system.scene.get();
  refuse("impacts", scene != nullptr && scene->has_impacts() && request.impacts,
         "Impacts are applied in double precision only: with precision extended give impacts=false.");
}

/// What extended precision has beyond doubles, and what it has not.
void check_precision(SimulateRequest& request, Findings& findings) {
  if (request.is_extended()) {
    check_extended(request, findings);
    for (const char* tolerance : {"rtol", "atol"}) {
      if (findings.is_defaulted(tolerance)) findings.echo().erase(tolerance);
    }
    return;
  }
  if (request.digits > most_digits_of_doubles) {
    findings.report("digits", "out_of_range",
                    "'digits' must be from 1 to 17; precision=extended has up to 31.");
  }
  if (request.max_error && *request.max_error < limits::least_error) {
    findings.report("max_error", "out_of_range",
                    "'max_error' must be from 1e-14 to 1; precision=extended goes down to 1e-24.");
  }
}

/// T and V are columns where a scene has them.
void check_energies(const SimulateRequest& request, const Scene& scene, Findings& findings) {
  const auto is_asked_for = [&](Extra extra) { return std::ranges::count(request.include, extra) != 0; };
  if (scene.lagrangian.empty()) return;
  if (!is_asked_for(Extra::kinetic_energy) && !is_asked_for(Extra::potential_energy)) return;
  findings.report("include", "not_applicable",
                  "A Lagrangian alone does not tell what of it is T and what V: include energy, which is "
                  "the Jacobi integral h.");
}

/// The grid is checked only when its own fields could be read; the others do not matter to it.
void check_simulate(SimulateRequest& request, Findings& findings) {
  const Scene* scene = request.system.scene.get();
  if (scene == nullptr) return;
  if (!findings.has_error_at({"t_start", "t_end", "samples", "dt", "times", "include"})) {
    check_grid(request, findings);
  } else if (!findings.has_error_at({"t_start", "t_end"}) && request.t_end &&
             *request.t_end <= request.t_start) {
    findings.report("t_end", "out_of_range", "'t_end' must be later than 't_start'.");
  }
  if (!findings.has_error_at({"include"})) check_energies(request, *scene, findings);
  if (!findings.has_error_at({"events"})) check_events(*scene, request.events, findings);
  check_inputs(request.system, findings);
  check_step(request, findings);
  complete_tolerances(request, findings);
  check_precision(request, findings);
  if (request.steps && (!scene->has_impacts() || !request.impacts)) {
    findings.report("steps", "not_applicable",
                    scene->has_impacts()
                        ? "'steps' counts impacts, and 'impacts': false leaves them out."
                        : scene->name + " has no impacts, which 'steps' counts. Rows are 'samples'.");
  }
  const bool has_goal = request.accuracy || request.max_error || request.max_evaluations;
  if (!request.verify && has_goal) {
    findings.report("verify", "exclusive", "An error that is wanted must be measured: leave 'verify' out.");
  }
  check_impacts(request, findings);
}

/// `auto` leaves the choice to the service: the first method reaches every accuracy with the least work.
Words<Method> words_of_choice() {
  Words<Method> words = words_of_methods();
  words.insert(words.begin(), {"auto", words.front().second});
  return words;
}

RequestTable<SimulateRequest> make_simulate_table() {
  std::vector<RequestField<SimulateRequest>> fields{
      system_field<SimulateRequest>(), parameters_field<SimulateRequest>(), initial_field<SimulateRequest>(),
      inputs_field<SimulateRequest>()};
  append_grid_fields(fields);
  const std::vector<RequestField<SimulateRequest>> rest{
      choices("include", &SimulateRequest::include,
              {{"energy", Extra::energy},
               {"T", Extra::kinetic_energy},
               {"V", Extra::potential_energy},
               {"momenta", Extra::momenta},
               {"positions", Extra::positions},
               {"accelerations", Extra::accelerations},
               {"multipliers", Extra::multipliers},
               {"validity", Extra::validity}},
              "columns beside t, the coordinates and the velocities",
              {.default_value = Json::array(), .aliases = {"columns", "outputs", "extra"}}),
      list("events", &SimulateRequest::events, TextKind{limits::expression_bytes}, limits::events,
           "events to report: theta=0, theta=0+ (only while it rises), theta=0- (only while it falls)",
           {.default_value = Json::array()}),
      on_invalid_field<SimulateRequest>(
          "what to do where the model stops holding, such as at a slack string"),
      impacts_field<SimulateRequest>(),
      integer(
          "steps", &SimulateRequest::steps, {1, limits::impacts, UpperEnd::of_work},
          "number of impacts after which the motion is complete (the strides of a walker); given beside t_end or "
          "instead of it",
          {.aliases = {"strides", "n_steps", "impacts_count"}}),
      choice("method", &SimulateRequest::method, words_of_choice(), "the integrator; " + methods_in_words(),
             {.default_value = "auto", .aliases = {"solver", "integrator", "algorithm"}}),
      number("h", &SimulateRequest::h, {"s", {.lower = 0, .lower_open = true}},
             "step of method " + methods_of_fixed_step() +
                 ", in place of tolerances; the last one ends at t_end and may be shorter",
             {.aliases = {"fixed_step"}}),
      number("rtol", &SimulateRequest::rtol, {"1", {limits::least_rtol, limits::largest_rtol}},
             "relative local tolerance",
             {.default_value = 1e-9,
              .aliases = {"reltol", "rel_tol", "tol", "tolerance", "relative_tolerance", "eps", "epsilon",
                          "rel_error", "relative_error"}}),
      number("atol", &SimulateRequest::atol,
             {"1", {.lower = 0, .upper = limits::largest_atol, .lower_open = true}},
             "absolute local tolerance, in each column's own unit; 1e-12, or rtol/1000 where that is less",
             {.default_value = 1e-12, .aliases = {"abstol", "abs_tol", "absolute_tolerance"}}),
      choice("accuracy", &SimulateRequest::accuracy,
             {{"fast", Preset::fast}, {"balanced", Preset::balanced}, {"accurate", Preset::accurate}},
             "the error that is promised, relative to each column's largest magnitude: 1e-3, 1e-6 or 1e-9",
             {.aliases = {"preset", "quality", "precision_goal"}}),
      number("max_error", &SimulateRequest::max_error, {"1", {least_extended_error, 1}},
             "the largest global error that you accept, in each column's own unit, for coordinates and "
             "velocities in all rows; below 1e-14 it needs precision=extended",
             {.aliases = {"max_abs_error", "error", "global_error", "max_err", "err", "abs_error",
                          "absolute_error", "accuracy_goal", "error_bound", "target_error"}}),
      integer("max_evaluations", &SimulateRequest::max_evaluations,
              {1, limits::evaluations, UpperEnd::of_work},
              "the work allowed, as a number of evaluations of the accelerations, those that measure the "
              "error included",
              {.aliases = {"max_nfev", "budget", "max_rhs_evaluations"}}),
      boolean("verify", &SimulateRequest::verify, "whether the error of the answer is measured",
              {.default_value = true}),
      choice("precision", &SimulateRequest::precision,
             {{"double", Precision::double_precision}, {"extended", Precision::extended}},
             "extended: computed with twice the digits of doubles, from the decimals as they are typed; "
             "without it, double"),
      integer("digits", &SimulateRequest::digits, {1, most_digits},
              "significant digits of the answer's numbers, up to 17, or 31 with precision=extended; all "
              "without it",
              {.aliases = {"significant_digits", "significant_figures", "sigfigs", "decimals", "round"}}),
      choice("format", &SimulateRequest::format,
             {{"json", Format::json}, {"csv", Format::csv}, {"ndjson", Format::ndjson}},
             "form of the answer; without this field the Accept header decides"),
  };
  fields.insert(fields.end(), rest.begin(), rest.end());
  const OneOf accuracy{.ways = {{"rtol", "atol"}, {"accuracy"}, {"max_error"}, {"max_evaluations"}, {"h"}}};
  return RequestTable<SimulateRequest>(std::move(fields), {ways_of_grid, accuracy}, check_simulate);
}

}  // namespace

const RequestTable<SimulateRequest>& simulate_table() {
  static const RequestTable<SimulateRequest> table = make_simulate_table();
  return table;
}

std::int64_t column_count(const Scene& scene, const std::vector<Extra>& include) {
  const std::size_t coordinates = scene.coordinates.size();
  std::size_t count = 1 + 2 * coordinates;
  for (const Extra extra : include) {
    switch (extra) {
      case Extra::energy:
      case Extra::kinetic_energy:
      case Extra::potential_energy:
        count += 1;
        break;
      case Extra::momenta:
        count += coordinates;
        break;
      case Extra::accelerations:
        count += coordinates;
        break;
      case Extra::multipliers:
        count += scene.constraints.size();
        break;
      case Extra::validity:
        count += scene.valid_while.size() + scene.reports.size();
        break;
      case Extra::positions:
        for (const Point& point : scene.points) count += point.components.size();
        break;
    }
  }
  return static_cast<std::int64_t>(count);
}

}  // namespace qdot::api
