#include "core/motion/unseen_flights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

constexpr double next_of_looks = 4, roundings_of_look = 64;
constexpr double rounding_of_rates = 64 * std::numeric_limits<double>::epsilon();
constexpr double step_of_slopes = 1e-7;  ///< relative
constexpr double goes_on = 0.999;        ///< of a rate
constexpr double changing = 2;           ///< forces change along a flight

/// After that time, which may be below zero, with these accelerations.
std::vector<double> moved(std::vector<double> y, std::span<const double> accelerations, double time) {
  const std::size_t n = y.size() / 2;
  for (std::size_t i = 0; i < n; ++i) {
    y[i] += time * (y[n + i] + time / 2 * accelerations[i]);
    y[n + i] += time * accelerations[i];
  }
  return y;
}

/// sum_i |dg/dq_i v_i|.
double size_of_rate(const Watch& watch, double t, std::vector<double> y) {
  const std::size_t n = y.size() / 2;
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double place = y[i], step = step_of_slopes * std::max(1.0, std::abs(place));
    y[i] = place + step;
    const double above = watch.value(t, y);
    y[i] = place - step;
    sum += std::abs((above - watch.value(t, y)) / (2 * step) * y[n + i]);
    y[i] = place;
  }
  return sum;
}

}  // namespace

double UnseenFlights::pressing(const Watch& watch, const SectionRecord& impact) const {
  const std::vector<double>& y = impact.after;
  const std::size_t n = y.size() / 2;
  const std::vector<double> now = sections_.slopes(impact.t, y);
  const double inside = watch.direction == Crossing::falling ? -1 : 1, g = watch.value(impact.t, y);
  for (double tau = sections_.resolution(); tau < longest_; tau *= next_of_looks) {
    const auto change_by = [&](std::span<const double> slopes) {
      const std::span<const double> accelerations = slopes.last(n);
      return watch.value(impact.t + tau, moved(y, accelerations, tau)) +
             watch.value(impact.t - tau, moved(y, accelerations, -tau)) - 2 * g;
    };
    const double change = change_by(now);
    if (!(std::abs(change) > roundings_of_look * watch.own_rounding(impact.t, y))) continue;
    const std::vector<double> soon = sections_.slopes(impact.t + tau, moved(y, std::span(now).last(n), tau));
    return std::min(inside * change, inside * change_by(soon)) / (tau * tau);
  }
  return 0;
}

UnseenFlights::Left UnseenFlights::by_map(const Watch& watch, const SectionRecord& impact) const {
  const double after = std::abs(sides_.rate(watch, impact.t, impact.after).value);
  if (after <= rounding_of_rates * size_of_rate(watch, impact.t, impact.after)) return {};
  const double before = std::abs(sides_.rate(watch, impact.t, impact.before).value);
  return {after, before > 0 ? after / before : infinity};
}

double UnseenFlights::duration(const Watch& watch, const SectionRecord& impact, const Left& left) const {
  const double press = pressing(watch, impact);
  if (press < 0) return infinity;
  if (left.rate == 0) return 0;
  if (press == 0 || !(left.ratio < goes_on)) return infinity;
  return changing * 2 * left.rate / (press * (1 - left.ratio));
}

}  // namespace qdot
