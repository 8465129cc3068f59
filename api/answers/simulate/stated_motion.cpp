#include "api/answers/simulate/stated_motion.hpp"

#include <algorithm>
#include <cmath>

#include "api/answers/stated.hpp"
#include "core/integrate/methods.hpp"
#include "core/motion/column_errors.hpp"

namespace qdot::api {
namespace {

const char* why_not_bounded(const Simulation& motion) {
  if (!record_of(motion.method).expands()) {
    return "The error was measured with a second computation, but the steps of this method have no bound of "
           "what may happen between the places that they look at.";
  }
  return "The error was measured with a second computation, but for some steps no bound was found of what "
         "may happen between the places that they look at.";
}

bool are_within(double wanted, const Json& errors) {
  return std::all_of(errors.begin(), errors.end(), [&](const Json& e) { return e.get<double>() <= wanted; });
}

/// What `digits` rounds away is an error of the answer too.
Json with_rounding(double error, const Column& column, int digits) {
  double lost = 0;
  for (std::size_t i = 0; digits != shortest_digits && i < column.values.size(); ++i) {
    lost = std::max(lost, std::abs(rounded(column.values[i], digits) - column.values[i]));
  }
  return stated_bound(error + lost, shortest_digits);
}

/// Of coordinates and velocities, in which an error is wanted.
Json errors_of_state(const StatedMotion& motion) {
  Json json = Json::object();
  const std::vector<double>& errors = motion.measured.max_abs_error;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    const Column& column = motion.table[1 + k];
    json[column.name] = with_rounding(errors[k], column, motion.digits);
  }
  return json;
}

void add_tolerances(const StatedMotion& motion, Json& json) {
  if (motion.request.h) {
    json["h"] = *motion.request.h;
    json["symplectic"] = motion.measured.simulation.symplectic;
  } else {
    json["rtol"] = motion.measured.tolerances.rtol;
    json["atol"] = motion.measured.tolerances.atol;
  }
}

void add_errors(const StatedMotion& motion, Json& json) {
  const MeasuredSimulation& measured = motion.measured;
  json["max_abs_error"] = nullptr;
  json["horizon"] = nullptr;
  if (measured.max_abs_error.empty()) return;
  json["max_abs_error"] = stated_errors(motion);
  if (measured.horizon) json["horizon"] = *measured.horizon;
  if (!measured.at_impacts.empty()) json["at_impacts"] = measured.at_impacts;
  json["verified_by"] = record_of(measured.verified_by).name;
  json["bounded"] = measured.bounded;
}

/// Why there are no errors, or steps without a bound.
std::string reason_of_errors(const StatedMotion& motion) {
  const MeasuredSimulation& measured = motion.measured;
  if (measured.max_abs_error.empty())
    return motion.request.verify ? measured.reason : "The error was not measured, as 'verify' is false.";
  const bool is_told = measured.bounded || !measured.reason.empty();
  return is_told ? measured.reason : why_not_bounded(measured.simulation);
}

}  // namespace

Json stated_errors(const StatedMotion& motion) {
  const MeasuredSimulation& measured = motion.measured;
  Json json = errors_of_state(motion);
  const RowsWithErrors rows{
      .t = motion.grid, .states = measured.simulation.states, .errors = measured.max_abs_error};
  const auto others = motion.table.subspan(1 + measured.max_abs_error.size());
  std::vector<std::span<const double>> values;
  for (const Column& column : others) values.push_back(column.values);
  const std::vector<double> errors =
      column_errors(motion.dynamics, motion.columns, motion.parameters, rows, values);
  for (std::size_t k = 0; k < errors.size(); ++k) {
    if (std::isfinite(errors[k])) json[others[k].name] = with_rounding(errors[k], others[k], motion.digits);
  }
  return json;
}

Json accuracy_json(const StatedMotion& motion) {
  const MeasuredSimulation& measured = motion.measured;
  Json json{{"method", record_of(measured.simulation.method).name}};
  add_tolerances(motion, json);
  add_errors(motion, json);
  std::string reason = reason_of_errors(motion);
  if (measured.meets_request) {
    const std::optional<double>& wanted = motion.request.max_error;
    const bool rounded_away =
        *measured.meets_request && wanted && !are_within(*wanted, errors_of_state(motion));
    json["meets_request"] = *measured.meets_request && !rounded_away;
    if (rounded_away) reason = "The digits asked for round away more than the error asked for.";
  }
  const std::string doubt = measured.events_in_doubt.in_words();
  if (!doubt.empty()) reason += (reason.empty() ? "" : " ") + doubt;
  if (!reason.empty()) json["reason"] = reason;
  return json;
}

}  // namespace qdot::api
