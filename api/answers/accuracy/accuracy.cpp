#include <time.h>

#include <algorithm>
#include <array>
#include <limits>

#include "api/answers/accuracy/request.hpp"
#include "api/answers/bounds.hpp"
#include "api/answers/integration_failure.hpp"
#include "api/answers/lost_inertia.hpp"
#include "api/answers/stated.hpp"
#include "core/integrate/methods.hpp"

namespace qdot::api {
namespace {

constexpr std::array<double, 4> usual_errors{1e-3, 1e-6, 1e-9, 1e-12};
constexpr int measured_runs = 3;

/// CPU time of this thread in microseconds.
double cpu_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

std::string written(double value) {
  std::string text;
  append_number(text, value, 2);
  return text;
}

SimulationRequest motion(const AccuracyRequest& request, const ResolvedState& state) {
  SimulationRequest core;
  core.parameters = state.parameters;
  core.y_start = state.y;
  core.t_start = request.t_start;
  core.t_start_left_out = request.start.low;
  core.t_end = *request.t_end;
  core.grid = request.grid;
  core.limits = limits_of_run();
  core.impacts = request.impacts ? Impacts::apply : Impacts::ignore;
  return core;
}

class AccuracyAnswer {
 public:
  AccuracyAnswer(const Scene& scene, const AccuracyRequest& request, WorkPrecision& study)
      : scene_(scene), request_(request), study_(study) {}

  Json body() {
    run_all();
    Json body = Json::object();
    body["reference"] = reference_json();
    body["points"] = points_json();
    body["recommendations"] = recommendations_json();
    body["units"] = units();
    return body;
  }

 private:
  /// Runs all trials; a method is given up at its first run that was broken off.
  void run_all() {
    for (const Method method : request_.methods) {
      for (const Trial& trial : study_.trials(method)) {
        run(trial);
        if (results_.back().ending == Ending::step_limit) break;
      }
    }
  }

  void run(const Trial& trial) {
    results_.push_back(study_.run(trial));
    if (!request_.measure) {
      costs_.push_back(static_cast<double>(results_.back().evaluations));
      return;
    }
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < measured_runs; ++i) {
      const double start = cpu_time();
      study_.repeat(results_.back());
      least = std::min(least, cpu_time() - start);
    }
    costs_.push_back(least);
  }

  /// An error, rounded up to the digits asked for.
  [[nodiscard]] Json bound(double error) const {
    return stated_bound(error, request_.digits.value_or(shortest_digits));
  }

  [[nodiscard]] Json by_column(const std::vector<double>& values) const {
    Json json = Json::object();
    const std::vector<Symbol> state = symbols(scene_, SymbolRole::initial);
    for (std::size_t k = 0; k < values.size(); ++k) json[state[k].name] = bound(values[k]);
    return json;
  }

  [[nodiscard]] Json reference_json() const {
    const MeasuredSimulation& reference = study_.reference();
    return {{"method", record_of(reference.simulation.method).name},
            {"rtol", reference.tolerances.rtol},
            {"atol", reference.tolerances.atol},
            {"verified_by", record_of(reference.verified_by).name},
            {"max_abs_error", by_column(reference.max_abs_error)},
            {"evaluations", reference.simulation.evaluations}};
  }

  [[nodiscard]] Json points_json() const {
    const std::vector<bool> front = pareto_front(results_, costs_);
    Json points = Json::array();
    for (std::size_t i = 0; i < results_.size(); ++i) {
      Json point = point_json(results_[i]);
      point["on_front"] = static_cast<bool>(front[i]);
      if (request_.measure) point["measured"] = {{"cpu_us", costs_[i]}};
      points.push_back(std::move(point));
    }
    return points;
  }

  [[nodiscard]] static Json setting(const Trial& trial) {
    const MethodRecord& method = record_of(trial.method);
    if (method.has_fixed_step()) return {{"method", method.name}, {"h", trial.h}};
    return {{"method", method.name}, {"rtol", trial.tolerances.rtol}, {"atol", trial.tolerances.atol}};
  }

  [[nodiscard]] Json point_json(const TrialResult& result) const {
    Json point = setting(result.trial);
    point["evaluations"] = result.evaluations;
    point["steps"] = result.steps;
    if (result.max_abs_error.empty()) {
      point["error"] = nullptr;
      point["reason"] = result.ending == Ending::step_limit
                            ? "Broken off: it takes much more work than others."
                            : "The run did not come to its end.";
    } else {
      point["error"] = bound(result.error);
      point["max_abs_error"] = by_column(result.max_abs_error);
    }
    return point;
  }

  [[nodiscard]] Json recommendations_json() const {
    std::vector<double> wanted(usual_errors.begin(), usual_errors.end());
    if (request_.max_error) wanted = {*request_.max_error};
    Json array = Json::array();
    for (const double error : wanted) array.push_back(recommendation(error));
    return array;
  }

  [[nodiscard]] Json recommendation(double wanted) const {
    const auto best = cheapest(results_, costs_, wanted);
    if (!best) {
      return {{"max_error", wanted},
              {"method", nullptr},
              {"reason", "No run came within this error; the reference itself is not known better than " +
                             written(largest_reference_error()) + "."}};
    }
    const TrialResult& result = results_[*best];
    Json json = setting(result.trial);
    json["max_error"] = wanted;
    json["error"] = bound(result.error);
    json["evaluations"] = result.evaluations;
    json["text"] = "For " + written(wanted) + ": " + std::string(record_of(result.trial.method).name) +
                   (result.trial.h > 0 ? " with h " + written(result.trial.h)
                                       : " at rtol " + written(result.trial.tolerances.rtol)) +
                   ", " + std::to_string(result.evaluations) + " evaluations.";
    return json;
  }

  [[nodiscard]] double largest_reference_error() const {
    return std::ranges::max(study_.reference().max_abs_error);
  }

  [[nodiscard]] Json units() const {
    Json units = state_units(scene_);
    if (request_.measure) units["cpu_us"] = "us";
    return units;
  }

  const Scene& scene_;
  const AccuracyRequest& request_;
  WorkPrecision& study_;
  std::vector<TrialResult> results_;
  std::vector<double> costs_;  ///< evaluations, or microseconds where they are measured
};

Response answer_accuracy(const Resolved<AccuracyRequest>& resolved, Call& call, Models& models) {
  const auto& [request, echo] = resolved;
  const ResolvedSystem system = resolved_system(request.system, echo, models, request.t_start);
  note_lost_inertia(system, call);
  WorkPrecision study(*system.dynamics, motion(request, system.state));
  const Simulation& reference = study.reference().simulation;
  if (has_failed(reference.ending)) {
    return integration_failure(call, system.scene(), reference.ending, reference.t, reference.y);
  }
  if (study.reference().max_abs_error.empty()) {
    throw Error(ErrorCode::not_applicable,
                "There is no reference for this motion: " + study.reference().reason);
  }
  const Json body = AccuracyAnswer(system.scene(), request, study).body();
  call.timing.lap("solve");
  return written_answer(call, system.scene(), system.echo, body, request.digits);
}

}  // namespace

Endpoint accuracy_endpoint() {
  return {.name = "accuracy",
          .help = "The measured trade of error against work",
          .question = question(accuracy_table(), answer_accuracy),
          .cost = {.milliseconds = 100},
          .example =
              [](const Scene&, const Json&) {
                return std::optional(Json{{"t_end", 1}});
              },
          .other_names = {"errors_and_work", "benchmark", "work_precision", "precision"}};
}

}  // namespace qdot::api
