#include "core/motion/event_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numerics/constants.hpp"
#include "core/numerics/root.hpp"

namespace qdot {
namespace {

constexpr double shortest_step = 1e-7;  ///< for a slope, relative
constexpr double share = 1e-4;          ///< of the scale of the state, for slopes along the motion
constexpr double rounding_of_values = 8 * std::numeric_limits<double>::epsilon();

/// The smaller root of slope tau - curvature tau^2 / 2 = doubt.
std::optional<double> first_root(double slope, double curvature, double doubt) {
  const double discriminant = slope * slope - 2 * curvature * doubt;
  if (!(slope > 0) || !(discriminant >= 0)) return std::nullopt;
  return 2 * doubt / (slope + std::sqrt(discriminant));
}

}  // namespace

EventErrors::EventErrors(const Dynamics& dynamics, const SimulationRequest& request,
                         std::span<const double> scale)
    : dynamics_(dynamics),
      scale_(scale),
      watches_(watches(dynamics, {.parameters = request.parameters,
                                  .events = request.events,
                                  .on_invalid = request.on_invalid,
                                  .impacts = request.impacts})),
      workspace_(dynamics.accelerations().bind(request.parameters)) {}

std::optional<double> EventErrors::of(const EventRecord& event, std::span<const double> errors) {
  const auto watch = std::ranges::find_if(watches_, [&](const Watch& w) { return w.name == event.name; });
  return watch == watches_.end() ? std::nullopt : of(*watch, event.t, event.y, errors);
}

std::optional<double> EventErrors::of(const Stop& stop, std::span<const double> y,
                                      std::span<const double> errors) {
  const Watch* ended = nullptr;
  const auto distance = [&](const Watch& watch) { return std::abs(watch.value(stop.t, y)); };
  for (const Watch& watch : watches_) {
    const bool fits = watch.reason == stop.reason && watch.message == stop.message;
    if (fits && (ended == nullptr || distance(watch) < distance(*ended))) ended = &watch;
  }
  return ended == nullptr ? std::nullopt : of(*ended, stop.t, y, errors);
}

std::optional<double> EventErrors::of(const Watch& watch, double t, std::span<const double> y,
                                      std::span<const double> errors) {
  const std::size_t n = y.size() / 2;
  const std::vector<double> acceleration = accelerations(t, y);
  double tau = infinity;
  for (std::size_t k = 0; k < 2 * n; ++k) {
    const double rate = std::abs(k < n ? y[n + k] : acceleration[k - n]);
    if (rate > 0 && scale_[k] > 0) tau = std::min(tau, share * scale_[k] / rate);
  }
  if (!std::isfinite(tau)) return std::nullopt;
  const double before = watch.value(t - tau, state_after(-tau, t, y)), now = watch.value(t, y),
               after = watch.value(t + tau, state_after(tau, t, y));
  const double slope = std::abs(after - before) / (2 * tau);
  const double curvature = std::abs(after - 2 * now + before) / (tau * tau);
  const auto root = first_root(slope, curvature, std::abs(now) + doubt(watch, t, y, errors));
  if (!root) return std::nullopt;
  return *root + time_round_off(t);
}

double EventErrors::doubt(const Watch& watch, double t, std::span<const double> y,
                          std::span<const double> errors) const {
  std::vector<double> moved(y.begin(), y.end());
  double doubt = 0;
  for (std::size_t k = 0; k < y.size(); ++k) {
    const double h = std::max(errors[k], shortest_step * std::max(scale_[k], std::abs(y[k])));
    if (h == 0) continue;
    moved[k] = y[k] + h;
    const double beyond = watch.value(t, moved);
    moved[k] = y[k] - h;
    const double slope = std::abs(beyond - watch.value(t, moved)) / (2 * h);
    moved[k] = y[k];
    doubt += slope * (errors[k] + rounding_of_values * scale_[k]);
  }
  return doubt;
}

std::vector<double> EventErrors::accelerations(double t, std::span<const double> y) {
  std::vector<double> result(y.size() / 2);
  if (dynamics_.accelerations().evaluate(t, y, workspace_, result) != Evaluation::ok) {
    std::ranges::fill(result, std::numeric_limits<double>::quiet_NaN());
  }
  return result;
}

/// By the midpoint rule: right up to tau^2.
std::vector<double> EventErrors::state_after(double tau, double t, std::span<const double> y) {
  const std::size_t n = y.size() / 2;
  std::vector<double> moved(y.begin(), y.end());
  const auto move = [&](double length, const std::vector<double>& rates, std::span<const double> velocities) {
    for (std::size_t i = 0; i < n; ++i) {
      moved[i] = y[i] + length * velocities[i];
      moved[n + i] = y[n + i] + length * rates[i];
    }
  };
  move(tau / 2, accelerations(t, y), y.subspan(n));
  const std::vector<double> middle = moved;
  move(tau, accelerations(t + tau / 2, middle), std::span(middle).subspan(n));
  return moved;
}

}  // namespace qdot
