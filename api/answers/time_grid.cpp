#include "api/answers/time_grid.hpp"

#include <algorithm>
#include <cmath>

#include "api/answers/bounds.hpp"
#include "api/json/writer.hpp"

namespace qdot::api {
namespace {

using Grid = std::variant<std::vector<double>, GridError>;

std::string seconds(double value) {
  std::string text;
  append_number(text, value);
  return text + " s";
}

/// t_end has been checked.
Grid even_grid(double t_start, double t_end, std::int64_t rows, const std::string& field) {
  if (rows > most_rows_of_answer()) {
    return GridError{field, "too_many",
                     "That is " + std::to_string(rows) + " rows; an answer has at most " +
                         std::to_string(most_rows_of_answer()) + "."};
  }
  std::vector<double> instants;
  instants.reserve(static_cast<std::size_t>(rows));
  const double span = t_end - t_start;
  const auto steps = static_cast<double>(rows - 1);
  for (std::int64_t i = 0; i < rows; ++i) instants.push_back(t_start + static_cast<double>(i) * span / steps);
  instants.back() = t_end;
  if (std::ranges::adjacent_find(instants, std::greater_equal<>{}) != instants.end()) {
    return GridError{field, "out_of_range",
                     "The instants are closer together than double precision can tell."};
  }
  return instants;
}

Grid stepped_grid(double t_start, double t_end, double dt) {
  const double span = t_end - t_start;
  const double steps = span / dt;
  const double whole = std::max(std::round(steps), 1.0);
  if (!(steps < 1e15)) return GridError{"dt", "out_of_range", "dt is too small for so long a motion."};
  if (std::abs(whole * dt - span) <= 1e-9 * span) {
    return even_grid(t_start, t_end, static_cast<std::int64_t>(whole) + 1, "dt");
  }
  const double fewer = std::max(std::floor(steps), 1.0);
  std::string nearest = seconds(rounded(span / fewer, 12));
  if (steps > 1) nearest += " and " + seconds(rounded(span / (fewer + 1), 12));
  return GridError{
      "dt", "out_of_range",
      "dt does not divide the " + seconds(span) + " from t_start to t_end; near it, " + nearest + " do."};
}

Grid given_grid(double t_start, double t_end, const std::vector<double>& times) {
  if (const auto t = std::ranges::adjacent_find(times, std::greater_equal<>{}); t != times.end()) {
    return GridError{"times", "not_increasing",
                     "'times' must increase; " + seconds(*t) + " is followed by " + seconds(*(t + 1)) + "."};
  }
  const auto outside = [&](double t) { return t < t_start || t > t_end; };
  if (const auto t = std::ranges::find_if(times, outside); t != times.end()) {
    return GridError{"times", "out_of_range",
                     "'times' has " + seconds(*t) + ", which is not from " + seconds(t_start) + " to " +
                         seconds(t_end) + "."};
  }
  return times;
}

}  // namespace

std::variant<std::vector<double>, GridError> time_grid(const GridRequest& request) {
  const auto& [t_start, asked_end, samples, dt, times] = request;
  if (!asked_end && times.empty())
    return GridError{"t_end", "missing", "'t_end' is missing: the end of the motion."};
  const double t_end = asked_end.value_or(times.empty() ? 0 : times.back());
  if (!(t_end > t_start)) {
    return GridError{asked_end ? "t_end" : "times", "out_of_range",
                     "The motion must end after t_start, " + seconds(t_start) + "; it would end at " +
                         seconds(t_end) + "."};
  }
  if (dt) return stepped_grid(t_start, t_end, *dt);
  if (samples) return even_grid(t_start, t_end, *samples, "samples");
  return given_grid(t_start, t_end, times);
}

}  // namespace qdot::api
