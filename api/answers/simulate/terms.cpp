#include "api/answers/simulate/terms.hpp"

#include <cmath>

#include "api/answers/bounds.hpp"
#include "api/answers/integration_failure.hpp"
#include "api/answers/simulate/included_columns.hpp"
#include "api/answers/time_grid.hpp"
#include "api/json/limits.hpp"

namespace qdot::api {
namespace {

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

/// The time [s] that so many impacts get. No motion of interest needs as much, and one that meets no impact
/// has to end some time.
double patience(const Model& model, std::span<const double> parameters, std::int64_t impacts) {
  constexpr double units_of_time_per_impact = 100;
  double unit = 1;
  if (const auto& scales = model.parsed.scales) {
    std::vector<Assignment> values;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      values.emplace_back(model.parsed.symbols.parameters[i], parameters[i]);
    }
    unit = evaluate(scales->time, values);
  }
  if (!std::isfinite(unit)) unit = 1;
  return units_of_time_per_impact * unit * static_cast<double>(impacts);
}

}  // namespace

Format format_of(const SimulateRequest& request, const Call& call) {
  if (request.format) return *request.format;
  if (call.accepted == csv_type) return Format::csv;
  return call.accepted == ndjson_type ? Format::ndjson : Format::json;
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

SimulationRequest core_request(const SimulateRequest& request, const Dynamics& dynamics,
                               const ResolvedState& state) {
  SimulationRequest core;
  core.parameters = state.parameters;
  core.y_start = state.y;
  core.t_start = request.t_start;
  core.t_start_left_out = request.start.low;
  if (request.steps) core.end_after_impacts = static_cast<std::size_t>(*request.steps);
  core.t_end = request.t_end ? *request.t_end
                             : core.t_start + patience(dynamics.model(), state.parameters, *request.steps);
  core.grid = request.grid;
  for (std::size_t i = 0; i < request.grid.size(); ++i)
    core.grid_left_out.push_back(request.grid.exact(i).low);
  core.columns = included_columns(dynamics.model(), request.include).columns;
  core.events = request.events;
  core.on_invalid = request.on_invalid;
  core.impacts = request.impacts ? Impacts::apply : Impacts::ignore;
  core.limits = limits_of_run();
  core.method = request.method;
  if (request.h) core.h = *request.h;
  if (request.rtol > 0) core.tolerances = {request.rtol, request.atol};  // else a goal decides
  return core;
}

std::vector<double> grid_to_last_impact(const SimulateRequest& request, const Dynamics& dynamics,
                                        SimulationRequest core) {
  core.columns.clear();
  core.events.clear();
  core.grid = {core.t_start};
  const Simulation first = simulate(dynamics, core);
  if (has_failed(first.ending)) return core.grid;  // the second run fails as this one
  if (!first.stop && first.sections.size() < *core.end_after_impacts) {
    throw Error(ErrorCode::not_applicable, "Only " + std::to_string(first.sections.size()) +
                                               " impacts happen within " + std::to_string(core.t_end) +
                                               " s: give t_end.");
  }
  if (!request.dt) {
    const auto grid = time_grid(
        {.t_start = core.t_start, .t_end = first.t, .samples = request.samples, .dt = {}, .times = {}});
    if (std::holds_alternative<GridError>(grid)) return core.grid;
    return std::get<Reals>(grid);
  }
  std::vector<double> grid;
  for (std::int64_t i = 0; i < most_rows_of_answer(); ++i) {
    const double t = core.t_start + static_cast<double>(i) * *request.dt;
    if (t > first.t) break;
    grid.push_back(t);
  }
  return grid;
}

}  // namespace qdot::api
