#include "core/motion/event_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/numerics/constants.hpp"
#include "core/numerics/root.hpp"

namespace qdot {
namespace {

constexpr double shortest_step = 1e-7;  ///< for a slope, relative
constexpr double rounding_of_values = 8 * std::numeric_limits<double>::epsilon();
/// Of a component's largest magnitude: one that has not gone farther yet may be rounding, as of a ball that
/// is hit and hits the next one in the same instant.
constexpr double rounding_of_scale = 1e-3;
constexpr double tried_first = 1.05, tried_next = 1.5;  ///< of what is tried
constexpr double nearly_all = 0.9;                      ///< of a doubt, which is rounded itself
constexpr double much_more = 2;  ///< than slopes say: they are not the same all that time
constexpr double seen_beside = 16, some_roundings = 8, as_steep = 0.25;
constexpr double several_instants = 64;  ///< round-offs of time: zeros as near have one instant
constexpr double shortest_time = 1e-300;
constexpr double short_beside = 1e-6;   ///< the time that has passed: errors do not grow in it
constexpr double most_growth = 1;       ///< by the second order, of what is there by the first
constexpr double share = 1e-4;          ///< of that time, for slopes along the motion
constexpr double next_share = 10;       ///< times that, where values are rounded by as much as they change
constexpr double farthest_share = 0.1;  ///< of the time in which the motion goes through a component

}  // namespace

EventErrors::EventErrors(const Dynamics& dynamics, const SimulationRequest& request,
                         std::span<const double> scale)
    : dynamics_(dynamics),
      parameters_(request.parameters),
      scale_(scale),
      t_start_(request.t_start),
      watches_(watches(dynamics, {.parameters = request.parameters,
                                  .events = request.events,
                                  .on_invalid = request.on_invalid,
                                  .impacts = request.impacts})),
      workspace_(dynamics.accelerations().bind(request.parameters)) {}

std::optional<EventError> EventErrors::of(const EventRecord& event, std::span<const double> errors,
                                          std::span<const double> reached) {
  const auto watch = std::ranges::find_if(watches_, [&](const Watch& w) { return w.name == event.name; });
  return watch == watches_.end() ? std::nullopt
                                 : of(*watch, event.t, event.y, errors, reached, 0, event.untold);
}

std::optional<EventError> EventErrors::of(const Stop& stop, std::span<const double> y,
                                          std::span<const double> errors, double at_least) {
  const Watch* ended = nullptr;
  const auto distance = [&](const Watch& watch) { return std::abs(watch.value(stop.t, y)); };
  for (const Watch& watch : watches_) {
    const bool fits = watch.reason == stop.reason && watch.message == stop.message;
    if (fits && stop.t == t_start_ && sign_of(watch, stop.t, y, errors) != 0)
      return EventError{at_least, {errors.begin(), errors.end()}};
    if (fits && (ended == nullptr || distance(watch) < distance(*ended))) ended = &watch;
  }
  if (ended == nullptr) return std::nullopt;
  auto error = of(*ended, stop.t, y, errors, scale_, at_least);
  return error && !may_turn_before(stop.t, y, error->state) ? error : std::nullopt;
}

/// Whether a wall is as near as the errors: it may turn the motion before what stops it.
bool EventErrors::may_turn_before(double t, std::span<const double> y, std::span<const double> errors) const {
  std::vector<Interval> box;
  for (std::size_t k = 0; k < y.size(); ++k) box.emplace_back(y[k] - errors[k], y[k] + errors[k]);
  return std::ranges::any_of(watches_, [&](const Watch& watch) {
    return watch.kind == Watch::Kind::impact && sign_within(watch, t, box) == 0;
  });
}

std::optional<EventError> EventErrors::at(double t, std::span<const double> y, std::span<const double> errors,
                                          double time) {
  Place place{t, y, accelerations(t, y), {errors.begin(), errors.end()}};
  if (!std::ranges::all_of(place.accelerations, [](double a) { return std::isfinite(a); }))
    return std::nullopt;
  for (std::size_t k = 0; k < y.size(); ++k)
    place.errors[k] += rounding_of_values * std::max(scale_[k], std::abs(y[k]));
  return with_state(time, std::move(place));
}

bool EventErrors::breaks(const SectionRecord& impact, const Stop& stop,
                         std::span<const double> errors) const {
  return std::ranges::any_of(watches_, [&](const Watch& watch) {
    return watch.reason == stop.reason && watch.message == stop.message &&
           sign_of(watch, impact.t, impact.before, errors) > 0 &&
           sign_of(watch, impact.t, impact.after, errors) < 0;
  });
}

/// 0 where errors do not leave it one. A condition that has one at the start does not hold: by no error of
/// the state the motion goes on.
int EventErrors::sign_of(const Watch& watch, double t, std::span<const double> y,
                         std::span<const double> errors) {
  std::vector<Interval> state;
  for (std::size_t k = 0; k < y.size(); ++k) {
    const double error = errors[k] + rounding_of_values * std::abs(y[k]);
    state.emplace_back(y[k] - error, y[k] + error);
  }
  const Interval value = watch.enclosure(t, state);
  return value.lower > 0 ? 1 : value.upper < 0 ? -1 : 0;
}

std::optional<EventError> EventErrors::of(const Watch& watch, double t, std::span<const double> y,
                                          std::span<const double> errors, std::span<const double> reached,
                                          double at_least, double untold) {
  const std::size_t n = y.size() / 2;
  Place place{.t = t, .y = y, .accelerations = accelerations(t, y), .errors = {}, .untold = untold};
  double own_time = infinity, shortest = infinity;
  for (std::size_t k = 0; k < 2 * n; ++k) {
    const double size = std::max(reached[k], std::abs(y[k]));
    place.errors.push_back(errors[k] + rounding_of_values * size);
    const double rate = std::abs(k < n ? y[n + k] : place.accelerations[k - n]);
    if (!std::isfinite(rate)) return std::nullopt;
    const double range = size < rounding_of_scale * scale_[k] ? scale_[k] : size;
    if (!(rate > 0) || !(range > 0)) continue;
    shortest = std::min(shortest, (size > 0 ? size : range) / rate);
    own_time = std::min(own_time, range / rate);
  }
  if (!std::isfinite(own_time)) return std::nullopt;
  place.own_time = own_time;
  const std::optional<Time> time = time_of(watch, place, shortest, own_time);
  if (!time) return std::nullopt;
  const double merged = time->is_single ? 0 : several_instants * time_round_off(t);
  auto error = with_state(std::max(time->error, at_least) + merged, std::move(place));
  if (error) error->is_single = time->is_single;
  return error;
}

std::optional<EventError> EventErrors::with_state(double time, Place place) {
  std::vector<double> changes(place.y.size());
  const auto errors = errors_after(time, place);
  if (!errors) return std::nullopt;
  for (const double tau : {-time, time}) {
    const std::vector<double> y = state_after(tau, place);
    for (std::size_t k = 0; k < y.size(); ++k) changes[k] = std::max(changes[k], std::abs(y[k] - place.y[k]));
  }
  for (std::size_t k = 0; k < changes.size(); ++k) changes[k] = tried_first * changes[k] + (*errors)[k];
  return EventError{time, std::move(changes)};
}

std::optional<EventErrors::Time> EventErrors::time_of(const Watch& watch, Place& place, double shortest,
                                                      double own_time) {
  const double least = std::max({time_round_off(place.t), time_round_off(shortest), shortest_time});
  const Linear around = linear(watch, place);
  place.cancels = cancels(watch, place, around.doubt);
  const double guess = tried_first * around.doubt / std::abs(around.slope),
               farthest = farthest_share * own_time, value = std::abs(watch.value(place.t, place.y));
  // At a pole no slope tells.
  const bool is_told =
      guess <= farthest && value <= std::abs(watch.value(place.t + guess, state_after(guess, place)));
  // It may lie beside the place by as much as values are rounded there.
  const bool is_rounded = value <= watch.own_rounding(place.t, place.y);
  bool has_one_sign = false;
  const double first = is_told && !watch.may_jump ? std::max(least, guess) : least;
  for (double tau = first; tau <= farthest; tau *= tried_next) {
    const std::optional<int> before = sign_after(-tau, watch, place);
    const std::optional<int> after = before ? sign_after(tau, watch, place) : std::nullopt;
    if (after && *before != *after)
      return Time{tau + least,
                  passes_once(tau, watch, place) || (is_told && tau <= much_more * std::max(least, guess) &&
                                                     is_as_steep(tau, around.slope, watch, place))};
    has_one_sign = has_one_sign || after;
    if (after && !is_rounded) break;
  }
  return has_one_sign ? std::nullopt : by_slopes(watch, place, own_time, around.doubt);
}

/// In the states that the motion may have within tau.
bool EventErrors::passes_once(double tau, const Watch& watch, const Place& place) {
  const auto errors = watch.passes_once ? errors_after(tau, place) : std::nullopt;
  if (!errors) return false;
  if (place.apart.empty()) take_apart(place);
  const std::size_t n = place.y.size() / 2;
  std::vector<Interval> y, rates(2 * n);
  for (const double x : place.y) y.emplace_back(x);
  for (std::size_t i = 0; i < n; ++i) rates[n + i] = place.accelerations[i];
  for (const double length : {-tau, tau}) {
    const std::vector<double> there = state_after(length, place), a = accelerations(place.t + length, there);
    for (std::size_t k = 0; k < 2 * n; ++k) y[k] = hull(y[k], there[k]);
    for (std::size_t i = 0; i < n; ++i) rates[n + i] = hull(rates[n + i], a[i]);
  }
  for (std::size_t k = 0; k < 2 * n; ++k) y[k] = y[k] + Interval(-(*errors)[k], (*errors)[k]);
  for (std::size_t i = 0; i < n; ++i) {
    rates[i] = y[n + i];
    rates[n + i] = rates[n + i] + Interval(-place.apart[i], place.apart[i]);
  }
  return watch.passes_once({Interval(place.t - tau, place.t + tau), y, rates});
}

/// Whether an enclosure of g is wider than what slopes tell.
bool EventErrors::cancels(const Watch& watch, const Place& place, double doubt) const {
  std::vector<Interval> box;
  for (std::size_t k = 0; k < place.y.size(); ++k)
    box.emplace_back(place.y[k] - place.errors[k], place.y[k] + place.errors[k]);
  return !(watch.enclosure(place.t, box).radius() <= tried_first * doubt);
}

/// Whether g changes in some times tau about as its slope over larger distances says, or is rounded by as
/// much: a multiple root is flatter.
bool EventErrors::is_as_steep(double tau, double slope, const Watch& watch, const Place& place) {
  const double some_times = seen_beside * tau;
  double change = 0, rounding = 0;
  for (const double length : {-some_times, some_times}) {
    const std::vector<double> y = state_after(length, place);
    const double t = place.t + length;
    change += (length * slope > 0 ? 1 : -1) * watch.value(t, y);
    rounding += watch.own_rounding(t, y);
  }
  const double expected = 2 * some_times * std::abs(slope);
  return expected <= some_roundings * rounding ||
         (change >= as_steep * expected && as_steep * change <= expected);
}

/// Where g is enclosed too widely: the smaller root of
///   |g'| tau - |g''| tau^2/2 = |g| + sum_k |dg/dy_k| e_k + r,
/// with g' and g'' along the motion, and r what values of g are rounded by, of which slopes over a short time
/// may be all. An estimate.
std::optional<EventErrors::Time> EventErrors::by_slopes(const Watch& watch, const Place& place,
                                                        double own_time, double doubt) {
  for (double part = share; part <= farthest_share; part *= next_share) {
    const double tau = part * own_time;
    double rounding = 0;
    const auto g_after = [&](double length) {
      const std::vector<double> y = state_after(length, place);
      rounding = std::max(rounding, watch.own_rounding(place.t + length, y));
      return watch.value(place.t + length, y);
    };
    const double before = g_after(-tau), now = g_after(0), after = g_after(tau);
    const double slope = (std::abs(after - before) - 2 * rounding) / (2 * tau);
    const double curvature = (std::abs(after - 2 * now + before) + 4 * rounding) / (tau * tau);
    const double all = doubt + rounding, discriminant = slope * slope - 2 * curvature * all;
    if (!(slope > 0 && discriminant >= 0)) continue;
    const double first = 2 * all / (slope + std::sqrt(discriminant)) + time_round_off(place.t);
    double error = first;
    while (error <= farthest_share * own_time && !is_clear_of_zero(error, watch, place)) error *= tried_next;
    if (!(error <= farthest_share * own_time)) return std::nullopt;
    return Time{error, error <= much_more * first && place.untold <= 2 * error};
  }
  return std::nullopt;
}

/// Whether g has left zero by what it may be off there, to one side before and to the other after. At a
/// multiple root slopes over a longer time tell too much.
bool EventErrors::is_clear_of_zero(double tau, const Watch& watch, const Place& place) {
  double before = 0;
  for (const double length : {-tau, tau}) {
    const std::vector<double> y = state_after(tried_first * length, place);
    const double t = place.t + tried_first * length, value = watch.value(t, y);
    const auto errors = errors_after(length, place);
    if (!errors) return false;
    const Place there{t, y, accelerations(t, y), *errors, place.own_time};
    const double doubt = linear(watch, there).doubt - std::abs(value) + watch.own_rounding(t, y);
    if (!(std::abs(value) >= nearly_all * doubt)) return false;
    if (before != 0) return (before < 0) != (value < 0);
    before = value;
  }
  return false;
}

/// What each component may be off by then; none where that is told no longer.
std::optional<std::vector<double>> EventErrors::errors_after(double tau, const Place& place) {
  const std::size_t n = place.y.size() / 2;
  std::vector<double> errors = place.errors;
  const double length = std::abs(tau);
  const bool is_short = length <= short_beside * (place.t - t_start_);
  if (!is_short && place.apart.empty()) take_apart(place);
  for (std::size_t i = 0; i < n; ++i) {
    const double moved = length * place.errors[n + i], apart = is_short ? 0 : length * place.apart[i];
    if (!(length * apart <= most_growth * (place.errors[i] + moved))) return std::nullopt;
    errors[i] += moved + length * apart / 2;
    errors[n + i] += apart;
  }
  return errors;
}

void EventErrors::take_apart(const Place& place) {
  std::vector<double> moved(place.y.begin(), place.y.end());
  place.apart.resize(place.accelerations.size());
  for (std::size_t k = 0; k < moved.size(); ++k) {
    moved[k] = place.y[k] + place.errors[k];
    const std::vector<double> beyond = accelerations(place.t, moved);
    moved[k] = place.y[k] - place.errors[k];
    const std::vector<double> before = accelerations(place.t, moved);
    moved[k] = place.y[k];
    for (std::size_t i = 0; i < beyond.size(); ++i) {
      const double change = (beyond[i] - before[i]) / 2;
      const bool is_damping = k == beyond.size() + i && change < 0;
      if (!is_damping) place.apart[i] += std::abs(change);
    }
  }
}

/// By the midpoint rule: right up to tau^2.
std::vector<double> EventErrors::state_after(double tau, const Place& place) {
  const std::size_t n = place.y.size() / 2;
  std::vector<double> moved(place.y.begin(), place.y.end());
  const auto move = [&](double length, const std::vector<double>& rates, std::span<const double> velocities) {
    for (std::size_t i = 0; i < n; ++i) {
      moved[i] = place.y[i] + length * velocities[i];
      moved[n + i] = place.y[n + i] + length * rates[i];
    }
  };
  move(tau / 2, place.accelerations, place.y.subspan(n));
  const std::vector<double> middle = moved;
  move(tau, accelerations(place.t + tau / 2, middle), std::span(middle).subspan(n));
  return moved;
}

/// By slopes of g in each component.
EventErrors::Linear EventErrors::linear(const Watch& watch, const Place& place) const {
  const std::size_t n = place.y.size() / 2;
  std::vector<double> moved(place.y.begin(), place.y.end());
  Linear result{.doubt = std::abs(watch.value(place.t, place.y)), .slope = 0};
  for (std::size_t k = 0; k < moved.size(); ++k) {
    const double h = std::max(place.errors[k], shortest_step * std::max(scale_[k], std::abs(place.y[k])));
    if (h == 0) continue;
    moved[k] = place.y[k] + h;
    const double beyond = watch.value(place.t, moved);
    moved[k] = place.y[k] - h;
    const double partial = (beyond - watch.value(place.t, moved)) / (2 * h);
    moved[k] = place.y[k];
    result.doubt += std::abs(partial) * place.errors[k];
    result.slope += partial * (k < n ? place.y[n + k] : place.accelerations[k - n]);
  }
  const double tau = std::max(shortest_step * place.own_time, seen_beside * time_round_off(place.t));
  const double later = watch.value(place.t + tau, place.y), earlier = watch.value(place.t - tau, place.y);
  if (std::isfinite(later - earlier)) result.slope += (later - earlier) / (2 * tau);
  return result;
}

/// Of g in all states that the motion may have then; none where both occur. By Heun's rule, and the states
/// that it and Euler's differ by.
std::optional<int> EventErrors::sign_after(double tau, const Watch& watch, const Place& place) {
  const std::size_t n = place.y.size() / 2;
  std::vector<double> ahead(place.y.begin(), place.y.end());
  for (std::size_t i = 0; i < n; ++i) {
    ahead[i] += tau * place.y[n + i];
    ahead[n + i] += tau * place.accelerations[i];
  }
  const std::vector<double> then = accelerations(place.t + tau, ahead);
  const auto errors = errors_after(tau, place);
  if (!errors) return std::nullopt;
  std::vector<Interval> box(2 * n);
  const auto within = [](double middle, double radius) { return Interval(middle - radius, middle + radius); };
  for (std::size_t i = 0; i < n; ++i) {
    const double change = then[i] - place.accelerations[i];
    const double q = ahead[i] + tau * tau * (place.accelerations[i] / 2 + change / 6);
    const double v = ahead[n + i] + tau * change / 2;
    box[i] = within(q, (*errors)[i] + tau * tau * std::abs(change) / 6);
    box[n + i] = within(v, (*errors)[n + i] + std::abs(tau * change) / 2);
  }
  const int sign = sign_within(watch, place.t + tau, box, place.cancels);
  return sign != 0 ? std::optional(sign) : std::nullopt;
}

/// 0 where both occur. Where doubles round by as much, twice the digits may tell.
int EventErrors::sign_within(const Watch& watch, double t, std::span<const Interval> box,
                             bool cancels) const {
  const Interval values = watch.enclosure(t, box);
  if (!values.contains(0)) return values.lower > 0 ? 1 : -1;
  if (!watch.exact) return 0;
  Reals states;
  for (const Interval& y : box) states.push_back({y.middle(), 0, y.radius()});
  const Ball sharp = watch.exact(parameters_, t, states);
  if (!sharp.is_finite()) return 0;
  if (!sharp.contains_zero()) return sharp.value() > 0 ? 1 : -1;
  return cancels && watch.change_over ? sign_by_slopes(watch, t, box) : 0;
}

/// Of the middle, where slopes over the box do not lead to zero.
int EventErrors::sign_by_slopes(const Watch& watch, double t, std::span<const Interval> box) const {
  Reals middle;
  for (const Interval& y : box) middle.push_back(y.middle());
  const Ball value = watch.exact(parameters_, t, middle);
  const double change = watch.change_over(t, box).magnitude();
  if (!value.is_finite() || !(std::abs(value.value()) > value.radius + change)) return 0;
  return value.value() > 0 ? 1 : -1;
}

std::vector<double> EventErrors::accelerations(double t, std::span<const double> y) {
  std::vector<double> result(y.size() / 2);
  if (dynamics_.accelerations().evaluate(t, y, workspace_, result) != Evaluation::ok) {
    std::ranges::fill(result, std::numeric_limits<double>::quiet_NaN());
  }
  return result;
}

}  // namespace qdot
