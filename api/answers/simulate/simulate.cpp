#include <algorithm>
#include <cmath>

#include "api/answers/integration_failure.hpp"
#include "api/answers/lost_inertia.hpp"
#include "api/answers/simulate/extended.hpp"
#include "api/answers/simulate/included_columns.hpp"
#include "api/answers/simulate/motion_diagnostics.hpp"
#include "api/answers/simulate/request.hpp"
#include "api/answers/simulate/stated_motion.hpp"
#include "api/answers/simulate/terms.hpp"
#include "api/answers/stated.hpp"
#include "api/answers/units_of.hpp"
#include "core/motion/vanishing_speed.hpp"

namespace qdot::api {
namespace {

class SimulationAnswer {
 public:
  SimulationAnswer(const SimulateRequest& request, const ResolvedSystem& system, Call& call)
      : request_(request), call_(call), system_(system) {}

  Response response() {
    run();
    call_.timing.lap("solve");
    if (has_failed(result_.ending)) return failure();
    make_table();
    Response answer = format() == Format::json ? json() : rows();
    answer.evaluations = measured_.evaluations;
    call_.timing.lap("encode");
    return answer;
  }

 private:
  [[nodiscard]] Response failure() {
    std::string why = speed_that_vanished(dynamics(), system_.state.parameters, system_.state.y, result_);
    const Ending ending = why.empty() ? result_.ending : Ending::undetermined;
    if (request_.max_evaluations && ending == Ending::step_limit)
      why = "'max_evaluations' is not enough for this motion, even at the loosest tolerance.";
    return integration_failure(call_, scene(), ending, result_.t, result_.y, why);
  }

  [[nodiscard]] const Dynamics& dynamics() const { return *system_.dynamics; }
  [[nodiscard]] const Scene& scene() const { return system_.scene(); }
  [[nodiscard]] int digits() const { return request_.digits.value_or(shortest_digits); }
  [[nodiscard]] Format format() const { return format_of(request_, call_); }

  void run() {
    SimulationRequest core = core_request(request_, dynamics(), system_.state);
    columns_ = core.columns;
    if (core.grid.empty()) core.grid = grid_to_last_impact(request_, dynamics(), core);
    grid_ = core.grid;
    measured_ = simulate_with_error(dynamics(), core, goal_of(request_));
  }

  void add_column(const std::string& name, const std::string& unit, std::vector<double> values) {
    units_[name] = unit;
    values_.push_back(std::move(values));
    table_.push_back({name, values_.back()});
  }

  /// Column k of `rows` of `width` numbers.
  [[nodiscard]] std::vector<double> column(const std::vector<double>& rows, std::size_t width,
                                           std::size_t k) const {
    std::vector<double> values(result_.rows);
    for (std::size_t i = 0; i < result_.rows; ++i) values[i] = rows[i * width + k];
    return values;
  }

  void make_table() {
    const std::vector<Symbol> state = symbols(scene(), SymbolRole::initial);
    values_.reserve(1 + state.size() + columns_.size());
    const auto rows = static_cast<std::ptrdiff_t>(result_.rows);
    add_column("t", "s", {grid_.begin(), grid_.begin() + rows});
    for (std::size_t k = 0; k < state.size(); ++k) {
      add_column(state[k].name, state[k].unit, column(result_.states, state.size(), k));
    }
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      add_column(columns_[k].name, columns_[k].unit, column(result_.columns, columns_.size(), k));
    }
  }

  [[nodiscard]] StatedMotion stated() const {
    return {request_, dynamics(), system_.state.parameters, measured_, grid_, columns_, table_, digits()};
  }

  [[nodiscard]] const char* status() const { return result_.stop ? "stopped" : "complete"; }

  /// The trajectory row by row, as CSV or NDJSON; headers say how the motion ended.
  Response rows() {
    const bool csv = format() == Format::csv;
    Response response{.status = 200,
                      .content_type = csv ? csv_type : ndjson_type,
                      .headers = {{"X-Qdot-Status", status()}},
                      .body = csv ? to_csv(table_, digits()) : to_ndjson(table_, digits())};
    if (result_.stop) response.headers["X-Qdot-Stop"] = result_.stop->reason;
    if (!measured_.max_abs_error.empty()) {
      std::string errors = to_text(stated_errors(stated()));
      errors.pop_back();
      response.headers["X-Qdot-Max-Abs-Error"] = errors;
    }
    return response;
  }

  Response json() {
    JsonWriter writer(call_.layout, call_.wanted);
    writer.begin_object();
    write_head(writer, scene(), system_.echo, call_.notes);
    writer.member("status", status());
    if (result_.stop) writer.member("stop", stop_json(), digits());
    writer.member("t_reached", result_.t, digits());
    if (writer.wants("trajectory")) {
      writer.key("trajectory");
      writer.columns(table_, digits());
    }
    writer.member("units", with_units_of(scene(), Json{{"units", units_}})["units"]);
    if (writer.wants("events")) write_events(writer);
    if (!result_.stays.empty()) writer.member("sticking", sticking_json(result_), digits());
    if (scene().has_impacts() && request_.impacts)
      writer.member("strides", impacts_json(scene(), result_), digits());
    if (writer.wants("accuracy")) writer.member("accuracy", accuracy_json(stated()));
    if (writer.wants("diagnostics"))
      writer.member("diagnostics", with_units_of(scene(), diagnostics_json(result_, measured_.evaluations)));
    writer.end_object();
    return {
        .status = 200, .content_type = "application/json", .headers = {}, .body = std::move(writer).finish()};
  }

  [[nodiscard]] Json stop_json() const {
    Json json{{"reason", result_.stop->reason}, {"t", result_.stop->t}, {"message", result_.stop->message}};
    if (measured_.stop_error)
      json["error"] = stated_error(Stated{result_.stop->t, measured_.stop_error->time}, digits());
    const bool is_finite = std::ranges::all_of(result_.y, [](double value) { return std::isfinite(value); });
    if (!is_finite) return json;
    json["state"] = state_json(scene(), result_.y);
    if (measured_.stop_error) add_state_error(json, result_.y, measured_.stop_error->state);
    return json;
  }

  void add_state_error(Json& event, std::span<const double> y, std::span<const double> errors) const {
    const std::vector<Symbol> state = symbols(scene(), SymbolRole::initial);
    for (std::size_t k = 0; k < errors.size(); ++k)
      event["state_error"][state[k].name] = stated_error(Stated{y[k], errors[k]}, digits());
  }

  [[nodiscard]] const EventError* error_of_event(std::size_t i) const {
    const auto& errors = measured_.event_errors;
    return i < errors.size() && errors[i] ? &*errors[i] : nullptr;
  }

  [[nodiscard]] Json event_json(std::size_t i) const {
    const EventRecord& event = result_.events[i];
    Json json{{"name", event.name}, {"t", event.t}};
    const EventError* error = error_of_event(i);
    if (error != nullptr) {
      json["error"] = stated_error(Stated{event.t, error->time}, digits());
    } else if (!measured_.max_abs_error.empty()) {
      json["error"] = nullptr;
      json["reason"] =
          "It is too near to where the event would not happen, or after the last row, for the error "
          "of its time to be told.";
    }
    json["state"] = state_json(scene(), event.y);
    if (error != nullptr) add_state_error(json, event.y, error->state);
    return json;
  }

  /// Writes one event after the other, because all of them as one JSON value would take many times the memory
  /// of their text.
  void write_events(JsonWriter& writer) const {
    writer.key("events");
    writer.begin_array();
    for (std::size_t i = 0; i < result_.events.size(); ++i) writer.value(event_json(i), digits());
    writer.end_array();
  }

  const SimulateRequest& request_;
  Call& call_;
  const ResolvedSystem& system_;
  std::vector<double> grid_;
  std::vector<qdot::Column> columns_;
  MeasuredSimulation measured_;
  const Simulation& result_{measured_.simulation};
  std::vector<std::vector<double>> values_;
  std::vector<Column> table_;
  Json units_ = Json::object();
};

Response answer_simulate(const Resolved<SimulateRequest>& resolved, Call& call, Models& models) {
  const SimulateRequest& request = resolved.request;
  ResolvedSystem system = resolved_system(request.system, resolved.echo, models, request.t_start);
  note_lost_inertia(system, call);
  put_in_exponents(system, request.system, request.events);
  for (const std::string& note : included_columns(system.dynamics->model(), request.include).notes)
    call.notes.push_back(note);
  if (request.is_extended()) return extended_answer(request, system, call);
  return SimulationAnswer(request, system, call).response();
}

}  // namespace

Endpoint simulate_endpoint() {
  return {.name = "simulate",
          .help = "The trajectory of a system",
          .question = question(simulate_table(), answer_simulate),
          .cost = {.motion = Cost::Motion::always},
          .example =
              [](const Scene&, const Json&) {
                return std::optional(Json{{"t_end", 10}});
              },
          .offers = {"application/json", csv_type, ndjson_type},
          .other_names = {"sim", "simulation", "run", "trajectory", "integrate", "solve", "motion", "ode"}};
}

}  // namespace qdot::api
