// What is known of a function along a piece of a step: the coefficients of a polynomial, and how far the
// function may be from it.

#include <algorithm>
#include <cmath>

#include "core/integrate/events.hpp"

namespace qdot {
namespace {

constexpr double short_share = 1e-9;  ///< of a piece

int sign_of_value(double value) { return (value > 0) - (value < 0); }

}  // namespace

bool EventSearch::UnitSeries::is_finite() const {
  return std::isfinite(off) && std::ranges::all_of(coefficients(), [](double c) { return std::isfinite(c); });
}

bool EventSearch::UnitSeries::is_zero() const {
  return off == 0 && std::ranges::all_of(c, [](double x) { return x == 0; });
}

EventSearch::UnitSeries EventSearch::unit_series(std::size_t event, const MotionPiece& piece,
                                                 unsigned order) const {
  UnitSeries result;
  result.end = order + 1;
  const std::span<double> c = std::span(result.c).first(result.end);
  result.off = request_.events[event].series(piece, order, c);
  result.is_nowhere = std::isnan(result.off);
  if (result.is_nowhere) return result;
  c[0] -= left_at_start_[event];
  double power = 1, size = 0;
  for (double& coefficient : c) {
    coefficient *= power;
    power *= piece.h;
    size += std::abs(coefficient);
  }
  const double rounding = of_values * size;
  result.off += rounding + rounding_[event];
  // What was typed is known to more digits than t has.
  const double instants = request_.events[event].rounding_at_start ? 0 : 16;
  const double of_time = instants * of_values * (std::abs(piece.t) / piece.h) * std::abs(c[1]);
  // At t_start itself the polynomial is g up to rounding, however far from it g may be later.
  const bool is_zero = is_zero_at_start(event);
  if (piece.t == request_.t_start && (is_zero || std::abs(c[0]) <= result.off + of_time)) {
    const double value = value_at_start(event, c[0]);
    result.is_divided = is_zero || (!request_.events[event].is_beside_zero &&
                                    std::abs(value) <= doubt_at_start(event, piece, 0, rounding) + of_time);
    const bool is_known = !result.is_divided && request_.events[event].rounding_at_start;
    if (is_known) result.sign_at_start = sign_of_value(value);
  }
  if (result.is_divided) result.first = 1;
  return result;
}

/// The state there has not been rounded by a series.
double EventSearch::value_at_start(std::size_t event, double of_series) const {
  const double value = request_.events[event].value(request_.t_start, request_.y_start);
  return std::abs(value) < std::abs(of_series) ? value : of_series;
}

/// What g may be away from its first coefficient: the bound over that share of the piece, over none of which
/// no slope counts however steep, and rounding, which the whole step may show far larger than it is there.
double EventSearch::doubt_at_start(std::size_t event, MotionPiece piece, double share,
                                   double rounding) const {
  std::vector<double> c(low_order + 1);
  piece.h *= share;
  piece.defect = {};  // that of the whole step
  const EventFunction& function = request_.events[event];
  if (piece.t == request_.t_start && function.rounding_at_start)
    rounding = std::min(rounding, function.rounding_at_start());
  return function.series(piece, low_order, c) + rounding;
}

/// In as many coefficients as are numbers with a bound that is one: near overflow high ones are not.
EventSearch::UnitSeries EventSearch::finite_series(std::size_t event, const MotionPiece& piece) const {
  UnitSeries series = unit_series(event, piece, full_order);
  return series.is_finite() || series.is_nowhere ? series : unit_series(event, piece, low_order);
}

/// Whether g comes clear of what it may be away from its coefficients.
bool EventSearch::is_seen(const UnitSeries& series) {
  double size = 0;
  for (const double c : series.coefficients()) size += std::abs(c);
  return series.is_finite() && size > of_doubt * series.off;
}

/// g is zero up to the round-off of its values, all along: looking closer shows no more.
bool EventSearch::is_in_doubt(std::size_t event, const MotionPiece& piece, const UnitSeries& series) const {
  double size = 0;
  for (const double c : series.coefficients()) size += std::abs(c);
  return !series.is_divided && size <= of_doubt * series.off && is_rounding(event, piece, series);
}

/// Whether what g may be away from its coefficients is the rounding of its values.
bool EventSearch::is_rounding(std::size_t event, const MotionPiece& piece, const UnitSeries& series) const {
  double size = 0;
  for (const double c : series.coefficients()) size += std::abs(c);
  const double rounding = doubt_at_start(event, piece, short_share, of_values * size) + rounding_[event];
  return series.is_finite() && series.off <= 2 * rounding;
}

}  // namespace qdot
