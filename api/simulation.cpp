#include "api/simulation.hpp"

#include "core/analysis/simulation.hpp"

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
    core.t_end = *request_.t_end;
    core.grid = request_.grid;
    core.columns = columns_ = columns_of(model(), request_.include);
    core.events = request_.events;
    core.on_invalid = request_.on_invalid == OnInvalid::stop ? qdot::OnInvalid::stop : qdot::OnInvalid::go_on;
    core.impacts = request_.impacts ? Impacts::apply : Impacts::ignore;
    core.method = method_of(request_.method);
    core.tolerances = {request_.rtol, request_.atol};
    core.limits.interrupted = call_.request.interrupted;
    result_ = simulate(dynamics_, core);
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
    add_column("t", "s", {request_.grid.begin(), request_.grid.begin() + rows});
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

  [[nodiscard]] Json accuracy_json() const {
    return {{"method", name_of(result_.method)},
            {"rtol", request_.rtol},
            {"atol", request_.atol},
            {"max_abs_error", nullptr},
            {"horizon", nullptr},
            {"reason",
             "This version does not estimate the global error; rtol and atol bound each step's alone."}};
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
            {"rhs_evaluations", result_.evaluations}};
  }

  const SimulateRequest& request_;
  Json echo_;
  Call& call_;
  const Dynamics& dynamics_;
  std::vector<qdot::Column> columns_;
  Simulation result_;
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
