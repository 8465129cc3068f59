#include <algorithm>
#include <cmath>

#include "api/answers/integration_failure.hpp"
#include "api/answers/simulate/extended.hpp"
#include "api/answers/simulate/request.hpp"
#include "api/answers/simulate/terms.hpp"
#include "api/answers/stated.hpp"
#include "api/answers/units_of.hpp"
#include "core/motion/column_errors.hpp"

namespace qdot::api {
namespace {

class SimulationAnswer {
 public:
  SimulationAnswer(const Resolved<SimulateRequest>& resolved, Call& call, Models& models)
      : request_(resolved.request),
        call_(call),
        system_(resolved_system(request_.system, resolved.echo, models, request_.t_start)) {}

  Response response() {
    run();
    call_.timing.lap("solve");
    if (has_failed(result_.ending)) {
      const bool allowed_too_little = request_.max_evaluations && result_.ending == Ending::step_limit;
      return integration_failure(call_, scene(), result_.ending, result_.t, result_.y,
                                 allowed_too_little ? "'max_evaluations' is not enough for this motion, even "
                                                      "at the loosest tolerance."
                                                    : "");
    }
    make_table();
    Response answer = format() == Format::json ? json() : rows();
    answer.evaluations = measured_.evaluations;
    call_.timing.lap("encode");
    return answer;
  }

 private:
  [[nodiscard]] const Dynamics& dynamics() const { return *system_.dynamics; }
  [[nodiscard]] const Scene& scene() const { return system_.scene(); }
  [[nodiscard]] int digits() const { return request_.digits.value_or(shortest_digits); }
  [[nodiscard]] Format format() const { return format_of(request_, call_); }

  void run() {
    SimulationRequest core = core_request(request_, dynamics(), system_.state);
    columns_ = core.columns;
    if (core.grid.empty()) core.grid = grid_of_strides(request_, dynamics(), core);
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
      std::string errors = to_text(stated_errors());
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
    if (!result_.stays.empty()) writer.member("sticking", sticking_json(), digits());
    if (scene().has_impacts() && request_.impacts) writer.member("strides", strides_json(), digits());
    if (writer.wants("accuracy")) writer.member("accuracy", accuracy_json());
    if (writer.wants("diagnostics")) writer.member("diagnostics", with_units_of(scene(), diagnostics_json()));
    writer.end_object();
    return {
        .status = 200, .content_type = "application/json", .headers = {}, .body = std::move(writer).finish()};
  }

  [[nodiscard]] Json stop_json() const {
    Json json{{"reason", result_.stop->reason}, {"t", result_.stop->t}, {"message", result_.stop->message}};
    if (measured_.stop_error)
      json["error"] = stated_error(Stated{result_.stop->t, *measured_.stop_error}, digits());
    const bool is_finite = std::ranges::all_of(result_.y, [](double value) { return std::isfinite(value); });
    if (is_finite) json["state"] = state_json(scene(), result_.y);
    return json;
  }

  void add_error(Json& event, std::size_t i) const {
    if (measured_.max_abs_error.empty()) return;
    const std::vector<std::optional<double>>& errors = measured_.event_errors;
    if (i < errors.size() && errors[i]) {
      event["error"] = stated_error(Stated{result_.events[i].t, *errors[i]}, digits());
      return;
    }
    event["error"] = nullptr;
    event["reason"] =
        "It is too near to where the event would not happen, or after the last row, for the error "
        "of its time to be told.";
  }

  /// Writes one event after the other, because all of them as one JSON value would take many times the memory
  /// of their text.
  void write_events(JsonWriter& writer) const {
    writer.key("events");
    writer.begin_array();
    for (std::size_t i = 0; i < result_.events.size(); ++i) {
      const EventRecord& event = result_.events[i];
      Json json{{"name", event.name}, {"t", event.t}};
      add_error(json, i);
      json["state"] = state_json(scene(), event.y);
      writer.value(json, digits());
    }
    writer.end_array();
  }

  [[nodiscard]] Json sticking_json() const {
    Json array = Json::array();
    for (const StayRecord& stay : result_.stays) {
      array.push_back({{"where", stay.kink + " = 0"}, {"from", stay.from}, {"to", stay.to}});
    }
    return array;
  }

  [[nodiscard]] Json strides_json() const {
    Json array = Json::array();
    for (const SectionRecord& stride : result_.sections) {
      array.push_back({{"t", stride.t},
                       {"step_time", stride.duration},
                       {"pre_impact", state_json(scene(), stride.before)},
                       {"state", state_json(scene(), stride.after)}});
    }
    return array;
  }

  [[nodiscard]] Json accuracy_json() const {
    Json json{{"method", record_of(result_.method).name}};
    if (request_.h) {
      json["h"] = *request_.h;
      json["symplectic"] = result_.symplectic;
    } else {
      json["rtol"] = measured_.tolerances.rtol;
      json["atol"] = measured_.tolerances.atol;
    }
    json["max_abs_error"] = nullptr;
    json["horizon"] = nullptr;
    std::string reason = measured_.reason;
    if (measured_.max_abs_error.empty()) {
      if (!request_.verify) reason = "The error was not measured, as 'verify' is false.";
    } else {
      json["max_abs_error"] = stated_errors();
      if (measured_.horizon) json["horizon"] = *measured_.horizon;
      if (!measured_.at_impacts.empty()) json["at_impacts"] = measured_.at_impacts;
      json["verified_by"] = record_of(measured_.verified_by).name;
      json["bounded"] = measured_.bounded;
      if (!measured_.bounded && reason.empty()) reason = why_not_bounded();
    }
    if (measured_.meets_request) {
      const bool rounded_away =
          *measured_.meets_request && request_.max_error && !within(*request_.max_error, max_abs_errors());
      json["meets_request"] = *measured_.meets_request && !rounded_away;
      if (rounded_away) reason = "The digits asked for round more away than the error wanted.";
    }
    const std::string& doubt = measured_.events_in_doubt;
    if (!doubt.empty()) reason += (reason.empty() ? "" : " ") + doubt;
    if (!reason.empty()) json["reason"] = reason;
    return json;
  }

  [[nodiscard]] const char* why_not_bounded() const {
    if (result_.method != Method::taylor) {
      return "The error was measured with a second computation, but the steps of this method have no bound of "
             "what may happen between the places that they look at.";
    }
    return "The error was measured with a second computation, but for some steps no bound was found of what "
           "may happen between the places that they look at.";
  }

  [[nodiscard]] static bool within(double wanted, const Json& errors) {
    return std::all_of(errors.begin(), errors.end(),
                       [&](const Json& e) { return e.get<double>() <= wanted; });
  }

  /// What `digits` rounds away is an error of the answer too.
  [[nodiscard]] Json with_rounding(double error, const Column& column) const {
    double lost = 0;
    for (std::size_t i = 0; digits() != shortest_digits && i < column.values.size(); ++i) {
      lost = std::max(lost, std::abs(rounded(column.values[i], digits()) - column.values[i]));
    }
    return stated_bound(error + lost, shortest_digits);
  }

  /// Of coordinates and velocities, in which an error is wanted.
  [[nodiscard]] Json max_abs_errors() const {
    Json json = Json::object();
    for (std::size_t k = 0; k < measured_.max_abs_error.size(); ++k) {
      json[table_[1 + k].name] = with_rounding(measured_.max_abs_error[k], table_[1 + k]);
    }
    return json;
  }

  /// The same and what these errors make of the other columns.
  [[nodiscard]] Json stated_errors() const {
    Json json = max_abs_errors();
    const RowsWithErrors rows{.t = grid_, .states = result_.states, .errors = measured_.max_abs_error};
    const auto others = std::span(table_).subspan(1 + measured_.max_abs_error.size());
    std::vector<std::span<const double>> values;
    for (const Column& column : others) values.push_back(column.values);
    const std::vector<double> errors =
        column_errors(dynamics(), columns_, system_.state.parameters, rows, values);
    for (std::size_t k = 0; k < errors.size(); ++k) {
      if (std::isfinite(errors[k])) json[others[k].name] = with_rounding(errors[k], others[k]);
    }
    return json;
  }

  [[nodiscard]] Json diagnostics_json() const {
    Json conserved = Json::array();
    for (const ConservedRecord& record : result_.conserved) {
      Json entry{{"name", record.name},
                 {"unit", record.unit},
                 {"initial", record.initial},
                 {"max_abs_drift", record.max_abs_drift}};
      if (record.max_rel_drift) {
        entry["max_rel_drift"] = *record.max_rel_drift;
      } else {
        entry["max_rel_drift"] = nullptr;
        entry["reason"] = "The initial value is 0.";
      }
      conserved.push_back(std::move(entry));
    }
    Json json{{"conserved", std::move(conserved)}};
    if (!result_.constraints.empty()) json["constraints"] = constraints_json();
    json["steps"] = result_.steps;
    json["rhs_evaluations"] = result_.evaluations;
    json["total_evaluations"] = measured_.evaluations;
    return json;
  }

  [[nodiscard]] Json constraints_json() const {
    Json array = Json::array();
    for (const ConstraintRecord& record : result_.constraints) {
      Json entry{{"name", record.name}};
      if (record.max_abs_value) entry["max_abs_value"] = *record.max_abs_value;
      entry["max_abs_rate"] = record.max_abs_rate;
      array.push_back(std::move(entry));
    }
    return array;
  }

  const SimulateRequest& request_;
  Call& call_;
  ResolvedSystem system_;
  std::vector<double> grid_;
  std::vector<qdot::Column> columns_;
  MeasuredSimulation measured_;
  const Simulation& result_{measured_.simulation};
  std::vector<std::vector<double>> values_;
  std::vector<Column> table_;
  Json units_ = Json::object();
};

Response answer_simulate(const Resolved<SimulateRequest>& resolved, Call& call, Models& models) {
  if (resolved.request.is_extended()) {
    const SimulateRequest& request = resolved.request;
    return extended_answer(request, resolved_system(request.system, resolved.echo, models, request.t_start),
                           call);
  }
  return SimulationAnswer(resolved, call, models).response();
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
