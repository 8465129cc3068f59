#include "core/motion/pressing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace qdot {
namespace {

constexpr double next_of_looks = 4, roundings_of_look = 64;
constexpr double roundings_of_places = 4;  ///< that are far from where the look begins
constexpr double rounding_of_rates = 64 * std::numeric_limits<double>::epsilon();
constexpr double rounding_of_pull = 8 * std::numeric_limits<double>::epsilon();
constexpr double longest_of_looks = 0.5;  ///< of the motion's span
constexpr double step_of_slopes = 1e-7;   ///< relative
constexpr int looks_at_surface = 2;

/// After that time, which may be below zero, with these accelerations.
std::vector<double> moved(std::vector<double> y, std::span<const double> accelerations, double time) {
  const std::size_t n = y.size() / 2;
  for (std::size_t i = 0; i < n; ++i) {
    y[i] += time * (y[n + i] + time / 2 * accelerations[i]);
    y[n + i] += time * accelerations[i];
  }
  return y;
}

/// dg/dq_i
double slope_of(const Watch& watch, double t, std::vector<double> y, std::size_t i) {
  const double place = y[i], step = step_of_slopes * std::max(1.0, std::abs(place));
  y[i] = place + step;
  const double above = watch.value(t, y);
  y[i] = place - step;
  return (above - watch.value(t, y)) / (2 * step);
}

/// sum_i |dg/dq_i x_i|
double sum_of_parts(const Watch& watch, double t, const std::vector<double>& y, std::span<const double> x) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += std::abs(slope_of(watch, t, y, i) * x[i]);
  return sum;
}

/// Where g has that value, near y: rates that rounding has left have led away from there, and forces that
/// lead back press nothing.
std::vector<double> on_surface(const Watch& watch, double t, std::vector<double> y, double g) {
  std::size_t steepest = 0;
  double slope = 0;
  for (std::size_t i = 0; i < y.size() / 2; ++i) {
    const double now = slope_of(watch, t, y, i);
    if (std::abs(now) > std::abs(slope)) slope = now, steepest = i;
  }
  for (int look = 0; look < looks_at_surface && slope != 0; ++look)
    y[steepest] -= (watch.value(t, y) - g) / slope;
  return y;
}

}  // namespace

double pressing(const Watch& watch, const SectionRecord& impact, const MotionSections& sections,
                double span) {
  const std::vector<double>& y = impact.after;
  const std::size_t n = y.size() / 2;
  const std::vector<double> now = sections.slopes(impact.t, y);
  const double inside = watch.direction == Crossing::falling ? -1 : 1, g = watch.value(impact.t, y);
  for (double tau = sections.resolution(); tau < longest_of_looks * span; tau *= next_of_looks) {
    const auto change_by = [&](std::span<const double> slopes) {
      const std::span<const double> accelerations = slopes.last(n);
      return watch.value(impact.t + tau, moved(y, accelerations, tau)) +
             watch.value(impact.t - tau, moved(y, accelerations, -tau)) - 2 * g;
    };
    const auto rounding_after = [&](double time) {
      return watch.rounding(impact.t + time, moved(y, std::span(now).last(n), time));
    };
    const std::vector<double> there =
        on_surface(watch, impact.t + tau, moved(y, std::span(now).last(n), tau), g);
    const std::vector<double> soon = sections.slopes(impact.t + tau, there);
    const auto rounding_of = [&](std::span<const double> slopes) {
      return rounding_of_pull * tau * tau * sum_of_parts(watch, impact.t, y, slopes.last(n));
    };
    const double seen = std::max({roundings_of_look * watch.own_rounding(impact.t, y),
                                  roundings_of_places * std::max(rounding_after(tau), rounding_after(-tau)),
                                  rounding_of(now), rounding_of(soon)});
    const double press = inside * change_by(now), press_soon = inside * change_by(soon);
    if (!(std::abs(press) > seen) && !(std::abs(press_soon) > seen)) continue;
    if (!(std::abs(press) > seen)) return press_soon / (tau * tau);  // it grows from nothing
    if (press * press_soon <= 0) return 0;
    return (std::abs(press) < std::abs(press_soon) ? press : press_soon) / (tau * tau);
  }
  return 0;
}

double rounding_of_rate(const Watch& watch, const SectionRecord& impact) {
  const std::size_t n = impact.after.size() / 2;
  std::vector<double> speeds;
  for (std::size_t i = n; i < 2 * n; ++i)
    speeds.push_back(std::max(std::abs(impact.before[i]), std::abs(impact.after[i])));
  return rounding_of_rates * sum_of_parts(watch, impact.t, impact.after, speeds);
}

}  // namespace qdot
