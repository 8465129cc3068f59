#pragma once
// The fields that say which motion is asked about, which stretch of it, and what computes it, for requests
// whose struct has the members they name: t_start, t_end, samples, dt, times, start and grid; on_invalid;
// impacts.

#include <string>
#include <vector>

#include "api/answers/bounds.hpp"
#include "api/answers/time_grid.hpp"
#include "api/contract/request_table.hpp"
#include "api/json/limits.hpp"
#include "core/dynamics/watch.hpp"
#include "core/integrate/methods.hpp"

namespace qdot::api {

inline constexpr Domain instants{.lower = -limits::largest_time, .upper = limits::largest_time};

/// Which of the grid's three ways was taken.
inline const OneOf ways_of_grid{.ways = {{"samples"}, {"dt"}, {"times"}}};

template <class R>
void append_grid_fields(std::vector<RequestField<R>>& fields) {
  fields.push_back(number("t_start", &R::t_start, {"s", instants}, "instant of the initial state",
                          {.default_value = 0.0, .aliases = {"t0", "tstart", "start"}}));
  fields.push_back(
      number("t_end", &R::t_end, {"s", instants}, "end of the motion; with `times` it may be left out",
             {.aliases = {"t", "time", "tmax", "t_max", "tend", "t_final", "tf", "end", "duration",
                          "stop_time", "t_span", "tspan", "t_stop", "until", "length_of_time"}}));
  fields.push_back(integer("samples", &R::samples, {2, limits::rows, UpperEnd::of_work},
                           "number of rows, the two ends of the motion included",
                           {.default_value = 101,
                            .aliases = {"n", "rows", "points", "num", "number_of_points", "n_points",
                                        "n_samples", "num_points", "npoints"}}));
  fields.push_back(
      number("dt", &R::dt, {"s", {.lower = 0, .lower_open = true}},
             "time between rows, which has to divide the time span",
             {.aliases = {"step", "dtmax", "delta_t", "timestep", "step_size", "time_step", "stepsize"}}));
  fields.push_back(list("times", &R::times, NumberKind{"s", instants}, limits::rows,
                        "the instants of the rows, increasing", {.aliases = {"t_eval", "saveat", "t_grid"}}));
}

/// The methods of integration by name, the best first.
[[nodiscard]] Words<Method> words_of_methods();

/// "taylor: Taylor series of order 16 or 20; erk: ...", for the description of a field.
[[nodiscard]] std::string methods_in_words();

/// "gauss": the methods whose step has a fixed length; the others choose theirs.
[[nodiscard]] std::string methods_of_fixed_step();

template <class R>
RequestField<R> on_invalid_field(std::string description) {
  return choice("on_invalid", &R::on_invalid, {{"stop", OnInvalid::stop}, {"continue", OnInvalid::go_on}},
                std::move(description), {.default_value = "stop"});
}

template <class R>
RequestField<R> impacts_field() {
  return boolean(
      "impacts", &R::impacts,
      "whether the system's impacts are applied; otherwise the motion goes on as if there were none",
      {.default_value = true});
}

template <class R>
void check_impacts(const R& request, Findings& findings) {
  const Scene& scene = *request.system.scene;
  if (request.impacts || scene.has_impacts()) return;
  findings.report("impacts", "not_applicable", scene.name + " has no impacts to leave out.");
}

/// Fills `start`, `grid`, and `t_end` where `times` stands for it. `columns` is how many numbers a row has.
template <class R>
void read_grid(R& request, std::int64_t columns, Findings& findings) {
  if (findings.echo().contains("times") && request.times.empty()) {
    findings.report("times", "empty", "'times' needs at least one instant.");
    return;
  }
  request.start = findings.exact("t_start", request.t_start);
  std::optional<Real> end;
  if (request.t_end) end = findings.exact("t_end", *request.t_end);
  auto grid = time_grid({.t_start = request.start,
                         .t_end = end,
                         .samples = request.samples,
                         .dt = request.dt,
                         .times = findings.exact("times", request.times)});
  if (const auto* error = std::get_if<GridError>(&grid)) {
    findings.report(error->field, error->code, error->detail);
    return;
  }
  request.grid = std::get<Reals>(std::move(grid));
  if (!request.t_end) request.t_end = request.times.back();
  findings.echo()["t_end"] = *request.t_end;
  const auto rows = static_cast<std::int64_t>(request.grid.size());
  if (rows * columns > most_numbers_of_answer()) {
    findings.report(findings.echo().contains("include") ? "include" : "samples", "too_many",
                    std::to_string(rows) + " rows of " + std::to_string(columns) + " columns are " +
                        std::to_string(rows * columns) + " numbers; an answer has at most " +
                        std::to_string(most_numbers_of_answer()) + ".");
  }
}

}  // namespace qdot::api
