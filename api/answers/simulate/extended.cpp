#include "api/answers/simulate/extended.hpp"

#include <algorithm>
#include <cmath>

#include "api/answers/bounds.hpp"
#include "api/answers/integration_failure.hpp"
#include "api/answers/simulate/extended_number.hpp"
#include "api/answers/simulate/terms.hpp"
#include "api/answers/units_of.hpp"
#include "core/base/work.hpp"
#include "core/compile/extended/expansion.hpp"
#include "core/compile/extended/tape.hpp"
#include "core/motion/column_errors.hpp"
#include "core/motion/extended_simulation.hpp"

namespace qdot::api {
namespace {

constexpr const char* kinks =
    "Extended precision needs forces without kinks: this motion has abs or sign in its equations.";
constexpr const char* nobody_watches =
    "The conditions under which the motion is valid are checked by a computation in doubles, which loses this "
    "motion before t_end; choose an earlier t_end or leave 'precision' out.";
constexpr const char* not_bounded =
    "The error was measured with other computations, but for some steps no bound was found of what may "
    "happen between the places that they look at.";
constexpr const char* conditions_not_bounded =
    "The conditions under which the motion is valid are checked by a computation in doubles, and for some steps "
    "no bound was found of what happens to them between the places that are looked at.";
constexpr const char* digits_round_away = "The digits asked for round away more than the error asked for.";
constexpr const char* contradicted =
    "The computation in doubles, which watches this one, differs from it by more than the sum of their errors.";

class ExtendedAnswer {
 public:
  ExtendedAnswer(const SimulateRequest& request, const ResolvedSystem& system, Call& call)
      : request_(request), system_(system), call_(call), grid_(double_doubles(request.grid)) {}

  Response response() {
    if (!has_extended_expansion(system_.dynamics->accelerations()))
      throw Error(ErrorCode::not_applicable, kinks);
    watch();
    if (has_failed(watched_.simulation.ending)) {
      return integration_failure(call_, system_.scene(), watched_.simulation.ending, watched_.simulation.t,
                                 watched_.simulation.y);
    }
    run();
    call_.timing.lap("solve");
    if (has_failed(result_.run.ending)) return failure();
    make_columns();
    Response answer = format_of(request_, call_) == Format::json ? json() : rows();
    answer.evaluations = watched_.evaluations + result_.evaluations;
    call_.timing.lap("encode");
    return answer;
  }

 private:
  struct TextColumn {
    std::string name;
    std::vector<std::string> values;
  };

  [[nodiscard]] int digits() const { return request_.digits.value_or(most_digits); }
  [[nodiscard]] std::size_t width() const { return system_.state.y.size(); }

  /// In doubles: what ends the motion, and its rows roughly.
  void watch() {
    SimulationRequest core = core_request(request_, *system_.dynamics, system_.state);
    core.columns.clear();
    core.tolerances = {1e-14, 1e-17};
    columns_ = core_request(request_, *system_.dynamics, system_.state).columns;
    watched_ = simulate_with_error(*system_.dynamics, core, {});
    const WatchRequest watched{
        .parameters = core.parameters, .events = {}, .on_invalid = core.on_invalid, .impacts = core.impacts};
    if (watches(*system_.dynamics, watched).empty()) return;
    if (watched_.max_abs_error.empty() || watched_.horizon)
      throw Error(ErrorCode::not_applicable, nobody_watches);
    doubts_of_conditions_ = watched_.events_in_doubt.in_words();
    if (doubts_of_conditions_.empty()) doubts_of_conditions_ = watched_.reason;
    if (doubts_of_conditions_.empty() && !watched_.bounded) doubts_of_conditions_ = conditions_not_bounded;
  }

  void run() {
    grid_.resize(watched_.simulation.stop ? watched_.simulation.rows : grid_.size());
    ExtendedSimulationRequest extended;
    extended.parameters = system_.state.parameters;
    extended.y_start = system_.state.y;
    extended.t_start = request_.start;
    for (std::size_t i = 0; i < grid_.size(); ++i) extended.grid.push_back(request_.grid.exact(i));
    extended.max_error = request_.max_error;
    extended.limits = limits_of_run();
    result_ = extended_simulation(*system_.dynamics, extended);
  }

  [[nodiscard]] Response failure() {
    std::vector<double> y;
    for (const DoubleDouble& component : result_.run.y) y.push_back(component.high);
    return integration_failure(call_, system_.scene(), result_.run.ending, result_.run.t.high, y);
  }

  void add_column(const std::string& name, const std::string& unit, const std::vector<DoubleDouble>& values) {
    units_[name] = unit;
    TextColumn column{name, {}};
    for (const DoubleDouble& value : values) {
      if (column.values.size() % 256 == 0) check_interruption();
      column.values.push_back(extended_text(value, digits()));
    }
    table_.push_back(std::move(column));
  }

  void make_columns() {
    const std::vector<Symbol> state = symbols(system_.scene(), SymbolRole::initial);
    const ExtendedRun& run = result_.run;
    add_column("t", "s", grid_);
    for (std::size_t k = 0; k < state.size(); ++k) {
      std::vector<DoubleDouble> values;
      for (std::size_t i = 0; i < run.rows; ++i) values.push_back(run.states[i * width() + k]);
      if (is_measured()) state_errors_.push_back(with_rounding(result_.max_abs_error[k], values));
      add_column(state[k].name, state[k].unit, values);
    }
    add_extra_columns();
  }

  [[nodiscard]] bool is_measured() const { return !result_.max_abs_error.empty(); }

  /// What `digits` rounds away is an error of the answer too: half a unit of the last digit.
  [[nodiscard]] double with_rounding(double error, const std::vector<DoubleDouble>& values) const {
    double largest = 0;
    for (const DoubleDouble& value : values) largest = std::max(largest, std::abs(value.high));
    if (largest == 0) return error;
    double unit = 1;
    while (unit <= largest) unit *= 10;
    while (unit > 10 * largest) unit /= 10;
    for (int i = 0; i < digits(); ++i) unit /= 10;
    return (error + unit / 2) * (1 + 1e-12);
  }

  void add_extra_columns() {
    if (columns_.empty()) return;
    const ExtendedRun& run = result_.run;
    std::vector<DoubleDouble> parameters;
    for (std::size_t i = 0; i < system_.state.parameters.size(); ++i)
      parameters.push_back(system_.state.parameters.exact(i).double_double());
    const auto function = system_.dynamics->columns(columns_);
    ExtendedTape tape(*function, parameters);
    ColumnErrors errors(*system_.dynamics, columns_, system_.state.parameters);
    std::vector<std::vector<DoubleDouble>> values(columns_.size());
    std::vector<DoubleDouble> row(columns_.size());
    for (std::size_t i = 0; i < run.rows; ++i) {
      const auto y = std::span(run.states).subspan(i * width(), width());
      if (tape.evaluate(grid_[i], y, row) != Evaluation::ok)
        throw Error(ErrorCode::invalid_state, "One of the columns has no finite value along this motion.");
      for (std::size_t k = 0; k < row.size(); ++k) values[k].push_back(row[k]);
      if (is_measured()) errors.add(instant(request_.grid.exact(i)), around(y), row);
    }
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (is_measured()) column_errors_.push_back(with_rounding(errors.largest()[k], values[k]));
      add_column(columns_[k].name, columns_[k].unit, values[k]);
    }
  }

  /// A row with its errors.
  [[nodiscard]] std::vector<Ball> around(std::span<const DoubleDouble> y) const {
    std::vector<Ball> balls;
    for (std::size_t k = 0; k < y.size(); ++k) balls.emplace_back(y[k], result_.max_abs_error[k]);
    return balls;
  }

  /// Whether both computations can be right, as far as doubles know the motion.
  [[nodiscard]] bool agrees_with_doubles() const {
    if (watched_.max_abs_error.empty() || result_.max_abs_error.empty() || watched_.horizon) return true;
    const std::vector<double>& rough = watched_.simulation.states;
    const std::vector<DoubleDouble>& fine = result_.run.states;
    for (std::size_t i = 0; i < std::min(rough.size(), fine.size()); ++i) {
      // Rows in doubles are at the doubles next to the instants.
      const std::size_t k = i % width();
      const double moved =
          k < width() / 2 ? 0x1p-51 * std::abs(grid_[i / width()].high) * std::abs(fine[i + width() / 2].high)
                          : 0;
      const double allowed = watched_.max_abs_error[k] + result_.max_abs_error[k] + moved;
      if (k < width() / 2 && std::abs((fine[i] - DoubleDouble(rough[i])).high) > allowed) return false;
    }
    return true;
  }

  [[nodiscard]] Json stated_errors() const {
    Json json = Json::object();
    for (std::size_t k = 0; k < width(); ++k) json[table_[1 + k].name] = state_errors_[k];
    for (std::size_t k = 0; k < column_errors_.size(); ++k) {
      if (std::isfinite(column_errors_[k])) json[columns_[k].name] = column_errors_[k];
    }
    return json;
  }

  [[nodiscard]] Json accuracy_json() const {
    Json json{{"method", "taylor"},          {"precision", "extended"},  {"rtol", result_.rtol},
              {"atol", result_.rtol * 1e-3}, {"max_abs_error", nullptr}, {"horizon", nullptr}};
    std::string reason = result_.reason;
    bool meets = result_.meets_request.value_or(false);
    if (is_measured()) {
      json["max_abs_error"] = stated_errors();
      if (result_.horizon) json["horizon"] = grid_[*result_.horizon].high;
      json["verified_by"] = "taylor";
      json["bounded"] = result_.bounded && doubts_of_conditions_.empty();
      if (!result_.bounded && reason.empty()) reason = not_bounded;
      if (!doubts_of_conditions_.empty()) reason += (reason.empty() ? "" : " ") + doubts_of_conditions_;
      if (meets && !json["bounded"].get<bool>()) meets = false;
      if (meets && std::ranges::max(state_errors_) > *request_.max_error) {
        meets = false;
        reason = digits_round_away;
      }
    }
    if (!agrees_with_doubles()) {
      meets = false;
      reason = contradicted;
    }
    if (result_.meets_request) json["meets_request"] = meets;
    if (!reason.empty()) json["reason"] = reason;
    return json;
  }

  [[nodiscard]] const char* status() const { return watched_.simulation.stop ? "stopped" : "complete"; }

  Response json() {
    JsonWriter writer(call_.layout);
    writer.begin_object();
    write_head(writer, system_.scene(), system_.echo, call_.notes);
    writer.member("status", status());
    const auto& stop = watched_.simulation.stop;
    if (stop) writer.member("stop", {{"reason", stop->reason}, {"t", stop->t}, {"message", stop->message}});
    writer.key("t_reached");
    writer.number_text(stop ? extended_text(stop->t, 17) : extended_text(grid_.back(), digits()));
    writer.key("trajectory");
    writer.begin_object();
    for (const TextColumn& column : table_) {
      writer.key(column.name);
      writer.number_texts(column.values);
    }
    writer.end_object();
    writer.member("units", with_units_of(system_.scene(), Json{{"units", units_}})["units"]);
    writer.member("events", Json::array());
    writer.member("accuracy", accuracy_json());
    writer.member("diagnostics", {{"conserved", Json::array()},
                                  {"steps", result_.run.steps},
                                  {"rhs_evaluations", result_.run.evaluations},
                                  {"total_evaluations", watched_.evaluations + result_.evaluations}});
    writer.end_object();
    return {
        .status = 200, .content_type = "application/json", .headers = {}, .body = std::move(writer).finish()};
  }

  /// CSV, or NDJSON.
  Response rows() {
    const bool csv = format_of(request_, call_) == Format::csv;
    Response response{.status = 200,
                      .content_type = csv ? csv_type : ndjson_type,
                      .headers = {{"X-Qdot-Status", status()}},
                      .body = {}};
    std::string& body = response.body;
    const auto separator = [&](std::size_t k) { return k + 1 < table_.size() ? "," : csv ? "\n" : "}\n"; };
    for (std::size_t k = 0; csv && k < table_.size(); ++k) body += table_[k].name + separator(k);
    for (std::size_t i = 0; i < result_.run.rows; ++i) {
      if (!csv) body += '{';
      for (std::size_t k = 0; k < table_.size(); ++k) {
        if (!csv) body += '"' + table_[k].name + "\":";
        body += table_[k].values[i] + separator(k);
      }
    }
    if (watched_.simulation.stop) response.headers["X-Qdot-Stop"] = watched_.simulation.stop->reason;
    const Json accuracy = accuracy_json();
    if (!accuracy["max_abs_error"].is_null()) {
      std::string errors = to_text(accuracy["max_abs_error"]);
      errors.pop_back();
      response.headers["X-Qdot-Max-Abs-Error"] = errors;
    }
    return response;
  }

  const SimulateRequest& request_;
  const ResolvedSystem& system_;
  Call& call_;
  std::vector<DoubleDouble> grid_;
  std::vector<qdot::Column> columns_;
  MeasuredSimulation watched_;
  std::string doubts_of_conditions_;
  ExtendedSimulation result_;
  std::vector<double> state_errors_, column_errors_;  ///< with what `digits` rounds away
  std::vector<TextColumn> table_;
  Json units_ = Json::object();
};

}  // namespace

Response extended_answer(const SimulateRequest& request, const ResolvedSystem& system, Call& call) {
  return ExtendedAnswer(request, system, call).response();
}

}  // namespace qdot::api
