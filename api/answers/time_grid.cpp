#include "api/answers/time_grid.hpp"

#include <algorithm>
#include <cmath>

#include "api/answers/bounds.hpp"
#include "api/json/writer.hpp"
#include "core/base/work.hpp"

namespace qdot::api {
namespace {

using Grid = std::variant<Reals, GridError>;

/// Of what double-doubles come to in the sum, the product and the quotient below.
constexpr double rounding_of_fractions = 0x1p-101;

std::string seconds(double value) {
  std::string text;
  append_number(text, value);
  return text + " s";
}

/// t_start + i/steps of the span.
Real even_instant(const Real& t_start, const DoubleDouble& span, double i, double steps) {
  const DoubleDouble later = span * DoubleDouble(i) / DoubleDouble(steps);
  const DoubleDouble t = t_start.double_double() + later;
  const double size = std::abs(t_start.value) + std::abs(later.high);
  return {t.high, t.low, t.low == 0 ? 0 : t_start.error + rounding_of_fractions * size};
}

/// t_end has been checked.
Grid even_grid(const Real& t_start, const Real& t_end, std::int64_t rows, const std::string& field) {
  if (rows > most_rows_of_answer()) {
    return GridError{field, "too_many",
                     "That is " + std::to_string(rows) + " rows; an answer has at most " +
                         std::to_string(most_rows_of_answer()) + "."};
  }
  Reals instants;
  const DoubleDouble span = t_end.double_double() - t_start.double_double();
  const auto steps = static_cast<double>(rows - 1);
  instants.push_back(t_start);
  for (std::int64_t i = 1; i + 1 < rows; ++i) {
    check_interruption(static_cast<std::uint64_t>(i));
    instants.push_back(even_instant(t_start, span, static_cast<double>(i), steps));
  }
  instants.push_back(t_end);
  if (std::ranges::adjacent_find(instants, std::greater_equal<>{}) != instants.end()) {
    return GridError{field, "out_of_range",
                     "The instants are closer together than double precision can tell."};
  }
  return instants;
}

Grid stepped_grid(const Real& t_start, const Real& t_end, double dt) {
  const double span = t_end.value - t_start.value;
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

bool is_earlier(const Real& a, const Real& b) { return (a.double_double() - b.double_double()).high < 0; }

Grid given_grid(const Real& t_start, const Real& t_end, const Reals& times) {
  if (const auto t = std::ranges::adjacent_find(times, std::greater_equal<>{}); t != times.end()) {
    return GridError{"times", "not_increasing",
                     "'times' must increase; " + seconds(*t) + " is followed by " + seconds(*(t + 1)) + "."};
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Real& t = times.exact(i);
    if (!is_earlier(t, t_start) && !is_earlier(t_end, t)) continue;
    return GridError{"times", "out_of_range",
                     "'times' has " + seconds(t.value) + ", which is not from " + seconds(t_start.value) +
                         " to " + seconds(t_end.value) + "."};
  }
  return times;
}

}  // namespace

std::variant<Reals, GridError> time_grid(const GridRequest& request) {
  const auto& [t_start, asked_end, samples, dt, times] = request;
  if (!asked_end && times.size() == 0)
    return GridError{"t_end", "missing", "'t_end' is missing: the end of the motion."};
  const Real t_end = asked_end ? *asked_end : times.exact(times.size() - 1);
  if (!(t_end.value > t_start.value)) {
    return GridError{asked_end ? "t_end" : "times", "out_of_range",
                     "The motion must end after t_start, " + seconds(t_start.value) + "; it would end at " +
                         seconds(t_end.value) + "."};
  }
  if (dt) return stepped_grid(t_start, t_end, *dt);
  if (samples) return even_grid(t_start, t_end, *samples, "samples");
  return given_grid(t_start, t_end, times);
}

}  // namespace qdot::api
