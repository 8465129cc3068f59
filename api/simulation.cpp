#include "api/simulation.hpp"

#include <algorithm>
#include <cmath>

#include "api/limits.hpp"
#include "api/time_grid.hpp"
#include "core/analysis/ladder.hpp"

namespace qdot::api {
namespace {

constexpr const char* csv_type = "text/csv";
constexpr const char* ndjson_type = "application/x-ndjson";

Method method_of(MethodChoice choice) {
  switch (choice) {
    case MethodChoice::adams:
      return Method::adams;
    case MethodChoice::bdf:
      return Method::bdf;
    case MethodChoice::erk:
      return Method::erk;
    case MethodChoice::automatic:  // it reaches every accuracy with the least work
    case MethodChoice::taylor:
      break;
  }
  return Method::taylor;
}

const char* name_of(Method method) {
  switch (method) {
    case Method::adams:
      return "adams";
    case Method::bdf:
      return "bdf";
    case Method::erk:
      return "erk";
    case Method::taylor:
      break;
  }
  return "taylor";
}

constexpr double promised(Preset preset) {
  switch (preset) {
    case Preset::fast:
      return 1e-3;
    case Preset::balanced:
      return 1e-6;
    case Preset::accurate:
      break;
  }
  return 1e-9;
}

AccuracyGoal goal_of(const SimulateRequest& request) {
  AccuracyGoal goal;
  goal.verify = request.verify;
  if (request.accuracy) {
    goal.kind = AccuracyGoal::Kind::relative;
    goal.value = promised(*request.accuracy);
  } else if (request.max_error) {
    goal.kind = AccuracyGoal::Kind::absolute;
    goal.value = *request.max_error;
  } else if (request.max_evaluations) {
    goal.kind = AccuracyGoal::Kind::work;
    goal.evaluations = static_cast<std::uint64_t>(*request.max_evaluations);
  }
  return goal;
}

std::vector<qdot::Column> columns_of(const Model& model, const std::vector<Extra>& include) {
  std::vector<qdot::Column> columns;
  const auto append = [&](std::vector<qdot::Column> more) {
    columns.insert(columns.end(), more.begin(), more.end());
  };
  for (const Extra extra : include) {
    switch (extra) {
      case Extra::energy:
        columns.push_back(model.energy ? qdot::Column{"energy", "J", *model.energy}
                                       : qdot::Column{"h", "J", model.jacobi});
        break;
      case Extra::momenta:
        append(momentum_columns(model));
        break;
      case Extra::positions:
        append(position_columns(model));
        break;
      case Extra::accelerations:
        append(acceleration_columns(model));
        break;
      case Extra::validity:
        append(validity_columns(model));
        break;
    }
  }
  return columns;
}

/// How a run that failed in its numbers is explained.
struct Failure {
  const char* reason;
  const char* detail;
};

Failure failure_of(Ending ending) {
  switch (ending) {
    case Ending::step_limit:
      return {"step-limit",
              "The motion needs more steps than a request may take; ask for a shorter one, or for less "
              "accuracy."};
    case Ending::nonfinite:
      return {"nonfinite", "The equations of motion became infinite or undefined."};
    case Ending::singular_mass:
      return {"singular-mass", "The mass matrix lost its inverse, so the accelerations are undetermined."};
    case Ending::tolerance:
      return {"tolerance",
              "The tolerances ask for more than double precision holds; choose larger rtol and atol."};
    case Ending::blow_up:
      return {"blow-up", "The motion grew beyond all bounds, or met a singularity that no step can pass."};
    case Ending::reached_end:
    case Ending::event:
    case Ending::interrupted:
      break;
  }
  return {"interrupted", "The computation was given up."};
}

class SimulationAnswer {
 public:
  SimulationAnswer(const Resolved<SimulateRequest>& resolved, Call& call, const Dynamics& dynamics)
      : request_(resolved.request), echo_(resolved.echo), call_(call), dynamics_(dynamics) {}

  Response response() {
    const ResolvedState state = resolved_state(model(), request_.system);
    fill_echo(echo_, model().scene, state);
    run(state);
    call_.timing.lap("solve");
    if (has_failed(result_.ending)) {
      return integration_failure(call_, model().scene, result_.ending, result_.t, result_.y);
    }
    make_table();
    Response answer = format() == Format::json ? json() : rows();
    call_.timing.lap("encode");
    return answer;
  }

 private:
  [[nodiscard]] const Model& model() const { return dynamics_.model(); }
  [[nodiscard]] int digits() const { return request_.digits.value_or(shortest_digits); }
  [[nodiscard]] Format format() const {
    if (request_.format) return *request_.format;
    if (call_.accepted == csv_type) return Format::csv;
    return call_.accepted == ndjson_type ? Format::ndjson : Format::json;
  }

  void run(const ResolvedState& state) {
    SimulationRequest core;
    core.parameters = state.parameters;
    core.y_start = state.y;
    core.t_start = request_.t_start;
    if (request_.steps) core.strides = static_cast<std::size_t>(*request_.steps);
    core.t_end = request_.t_end ? *request_.t_end : core.t_start + patience(state.parameters);
    core.grid = grid_ = request_.grid;
    core.columns = columns_ = columns_of(model(), request_.include);
    core.events = request_.events;
    core.on_invalid = request_.on_invalid == OnInvalid::stop ? qdot::OnInvalid::stop : qdot::OnInvalid::go_on;
    core.impacts = request_.impacts ? Impacts::apply : Impacts::ignore;
    core.method = method_of(request_.method);
    if (request_.rtol > 0) core.tolerances = {request_.rtol, request_.atol};  // else a goal decides
    core.limits.interrupted = call_.request.interrupted;
    if (grid_.empty()) core.grid = grid_ = grid_of_strides(core);
    measured_ = simulate_with_error(dynamics_, core, goal_of(request_));
  }

  /// Nothing that walks needs as long for its strides; what stands for ever must not walk for ever.
  [[nodiscard]] double patience(std::span<const double> parameters) const {
    constexpr double units_of_time_per_stride = 100;
    double unit = 1;
    if (const auto& scales = model().parsed.scales) {
      std::vector<Assignment> values;
      for (std::size_t i = 0; i < parameters.size(); ++i) {
        values.emplace_back(model().parsed.symbols.parameters[i], parameters[i]);
      }
      unit = evaluate(scales->time, values);
    }
    if (!std::isfinite(unit)) unit = 1;
    return units_of_time_per_stride * unit * static_cast<double>(*request_.steps);
  }

  /// Rows from the start to the last impact, or to the fall before it, as a first run finds it.
  [[nodiscard]] std::vector<double> grid_of_strides(SimulationRequest core) const {
    core.columns.clear();
    core.events.clear();
    core.grid = {core.t_start};
    const Simulation first = simulate(dynamics_, core);
    if (has_failed(first.ending)) return core.grid;  // the second run fails as this one
    if (!first.stop && first.strides.size() < *core.strides) {
      throw Error(ErrorCode::not_applicable, "Only " + std::to_string(first.strides.size()) +
                                                 " strides happen within " + std::to_string(core.t_end) +
                                                 " s: give t_end.");
    }
    if (!request_.dt) {
      const auto grid = time_grid(
          {.t_start = core.t_start, .t_end = first.t, .samples = request_.samples, .dt = {}, .times = {}});
      return std::holds_alternative<GridError>(grid) ? core.grid : std::get<std::vector<double>>(grid);
    }
    std::vector<double> grid;
    for (std::int64_t i = 0; i < limits::rows; ++i) {
      const double t = core.t_start + static_cast<double>(i) * *request_.dt;
      if (t > first.t) break;
      grid.push_back(t);
    }
    return grid;
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
    const std::vector<Symbol> state = symbols(model().scene, SymbolRole::initial);
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

  /// Row by row, as CSV or NDJSON; how the motion ended stands in the headers.
  Response rows() {
    const bool csv = format() == Format::csv;
    Response response{.status = 200,
                      .content_type = csv ? csv_type : ndjson_type,
                      .headers = {{"X-Qdot-Status", status()}},
                      .body = csv ? to_csv(table_, digits()) : to_ndjson(table_, digits())};
    if (result_.stop) response.headers["X-Qdot-Stop"] = result_.stop->reason;
    return response;
  }

  Response json() {
    JsonWriter writer(call_.layout);
    writer.begin_object();
    write_head(writer, model().scene, echo_);
    writer.member("status", status());
    if (result_.stop) {
      writer.member(
          "stop",
          {{"reason", result_.stop->reason}, {"t", result_.stop->t}, {"message", result_.stop->message}},
          digits());
    }
    writer.member("t_reached", result_.t, digits());
    writer.key("trajectory");
    writer.columns(table_, digits());
    writer.member("units", units_);
    writer.member("events", events_json(), digits());
    if (model().scene.impact && request_.impacts) writer.member("strides", strides_json(), digits());
    writer.member("accuracy", accuracy_json());
    writer.member("diagnostics", diagnostics_json());
    writer.end_object();
    return {
        .status = 200, .content_type = "application/json", .headers = {}, .body = std::move(writer).finish()};
  }

  [[nodiscard]] Json events_json() const {
    Json array = Json::array();
    for (const EventRecord& event : result_.events) {
      array.push_back({{"name", event.name}, {"t", event.t}, {"state", state_json(model().scene, event.y)}});
    }
    return array;
  }

  [[nodiscard]] Json strides_json() const {
    Json array = Json::array();
    for (const StrideRecord& stride : result_.strides) {
      array.push_back({{"t", stride.t},
                       {"step_time", stride.step_time},
                       {"pre_impact", state_json(model().scene, stride.before)},
                       {"state", state_json(model().scene, stride.after)}});
    }
    return array;
  }

  [[nodiscard]] Json accuracy_json() const {
    Json json{{"method", name_of(result_.method)},
              {"rtol", measured_.tolerances.rtol},
              {"atol", measured_.tolerances.atol},
              {"max_abs_error", nullptr},
              {"horizon", nullptr}};
    std::string reason = measured_.reason;
    if (measured_.max_abs_error.empty()) {
      if (!request_.verify) reason = "The error was not measured, as 'verify' is false.";
    } else {
      json["max_abs_error"] = max_abs_errors();
      if (measured_.horizon) json["horizon"] = *measured_.horizon;
      json["verified_by"] = name_of(measured_.verified_by);
    }
    if (measured_.meets_request) {
      const bool rounded_away =
          *measured_.meets_request && request_.max_error && !within(*request_.max_error, json);
      json["meets_request"] = *measured_.meets_request && !rounded_away;
      if (rounded_away) reason = "The digits asked for round more away than the error wanted.";
    }
    if (!reason.empty()) json["reason"] = reason;
    return json;
  }

  [[nodiscard]] static bool within(double wanted, const Json& accuracy) {
    const Json& errors = accuracy["max_abs_error"];
    return std::all_of(errors.begin(), errors.end(),
                       [&](const Json& e) { return e.get<double>() <= wanted; });
  }

  /// What `digits` rounds away is an error of the answer too.
  [[nodiscard]] Json max_abs_errors() const {
    Json json = Json::object();
    for (std::size_t k = 0; k < measured_.max_abs_error.size(); ++k) {
      const Column& column = table_[1 + k];
      double lost = 0;
      for (std::size_t i = 0; digits() != shortest_digits && i < column.values.size(); ++i) {
        lost = std::max(lost, std::abs(rounded(column.values[i], digits()) - column.values[i]));
      }
      json[column.name] = measured_.max_abs_error[k] + lost;
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
    return {{"conserved", std::move(conserved)},
            {"steps", result_.steps},
            {"rhs_evaluations", result_.evaluations},
            {"total_evaluations", measured_.evaluations}};
  }

  const SimulateRequest& request_;
  Json echo_;
  Call& call_;
  const Dynamics& dynamics_;
  std::vector<double> grid_;
  std::vector<qdot::Column> columns_;
  MeasuredSimulation measured_;
  const Simulation& result_{measured_.simulation};
  std::vector<std::vector<double>> values_;
  std::vector<Column> table_;
  Json units_ = Json::object();
};

}  // namespace

bool has_failed(Ending ending) { return ending != Ending::reached_end && ending != Ending::event; }

Response integration_failure(Call& call, const Scene& scene, Ending ending, double t,
                             std::span<const double> y) {
  if (ending == Ending::interrupted) {
    Response response =
        to_response({.kind = ProblemKind::deadline, .detail = "The computation was given up."},
                    call.target.path, call.layout);
    response.headers["Retry-After"] = "1";
    return response;
  }
  const Failure why = failure_of(ending);
  Json members{{"reason", why.reason}, {"t_reached", t}, {"last_state", state_json(scene, y)}};
  return to_response({.kind = ProblemKind::integration_failed,
                      .detail = why.detail,
                      .errors = {},
                      .members = std::move(members)},
                     call.target.path, call.layout);
}

Response answer_simulate(const Resolved<SimulateRequest>& resolved, Call& call, Models& models) {
  return guarded(
      call, [&] { return SimulationAnswer(resolved, call, *models.of(resolved.request.system)).response(); });
}

}  // namespace qdot::api
