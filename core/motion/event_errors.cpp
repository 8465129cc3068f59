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

bool EventErrors::passes_against(const EventRecord& place, std::span<const double> errors,
                                 std::span<const double> reached) {
  const auto watch = std::ranges::find_if(watches_, [&](const Watch& w) {
    return w.name == place.name && w.kind == Watch::Kind::event && w.direction != Crossing::either;
  });
  if (watch == watches_.end() || errors.empty()) return false;
  const std::optional<EventError> error = of(*watch, place.t, place.y, errors, reached);
  if (!error || !error->is_single) return false;
  StatesBeside states(dynamics_, workspace_, t_start_, place.t, place.y, {errors.begin(), errors.end()});
  const double before = watch->value(place.t - error->time, states.after(-error->time)),
               after = watch->value(place.t + error->time, states.after(error->time));
  return watch->direction == Crossing::rising ? before > 0 && after < 0 : before < 0 && after > 0;
}

std::optional<EventError> EventErrors::of(const Stop& stop, std::span<const double> y,
                                          std::span<const double> errors, double at_least) {
  std::vector<const Watch*> fitting;
  for (const Watch& watch : watches_) {
    if (watch.reason != stop.reason || watch.message != stop.message) continue;
    if (stop.t == t_start_ && sign_of(watch, stop.t, y, errors) != 0)
      return EventError{at_least, {errors.begin(), errors.end()}};
    fitting.push_back(&watch);
  }
  std::optional<EventError> error;
  for (const Watch* ended : in_order_of_zeros(std::move(fitting), stop.t, y)) {
    error = of(*ended, stop.t, y, errors, scale_, at_least);
    if (error) break;
  }
  return error && !may_turn_before(stop.t, y, error->state) ? error : std::nullopt;
}

/// Those first that are zero there but for rounding.
std::vector<const Watch*> EventErrors::in_order_of_zeros(std::vector<const Watch*> all, double t,
                                                         std::span<const double> y) {
  const auto is_zero = [&](const Watch* watch) {
    return std::abs(watch->value(t, y)) <= watch->rounding(t, y);
  };
  std::stable_partition(all.begin(), all.end(), is_zero);
  return all;
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
  std::vector<double> rounded(errors.begin(), errors.end());
  for (std::size_t k = 0; k < y.size(); ++k)
    rounded[k] += rounding_of_values * std::max(scale_[k], std::abs(y[k]));
  StatesBeside states(dynamics_, workspace_, t_start_, t, y, std::move(rounded));
  if (!std::ranges::all_of(states.accelerations(), [](double a) { return std::isfinite(a); }))
    return std::nullopt;
  return with_state(time, states);
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
  std::vector<double> sizes, rounded;
  for (std::size_t k = 0; k < y.size(); ++k) {
    sizes.push_back(std::max(reached[k], std::abs(y[k])));
    rounded.push_back(errors[k] + rounding_of_values * sizes[k]);
  }
  Place place{.states{dynamics_, workspace_, t_start_, t, y, std::move(rounded)}, .untold = untold};
  double own_time = infinity, shortest = infinity;
  for (std::size_t k = 0; k < y.size(); ++k) {
    const double rate = std::abs(place.states.rate(k)), size = sizes[k];
    if (!std::isfinite(rate)) return std::nullopt;
    const double range = size < rounding_of_scale * scale_[k] ? scale_[k] : size;
    if (!(rate > 0) || !(range > 0)) continue;
    shortest = std::min(shortest, (size > 0 ? size : range) / rate);
    own_time = std::min(own_time, range / rate);
  }
  if (!std::isfinite(own_time)) return std::nullopt;
  place.own_time = own_time;
  const std::optional<Time> time = time_of(watch, place, shortest);
  if (!time) return std::nullopt;
  const double merged = time->is_single ? 0 : several_instants * time_round_off(t);
  auto error = with_state(std::max(time->error, at_least) + merged, place.states);
  if (error) error->is_single = time->is_single;
  return error;
}

std::optional<EventError> EventErrors::with_state(double time, StatesBeside& states) {
  std::vector<double> changes(states.y().size());
  const auto errors = states.errors_after(time);
  if (!errors) return std::nullopt;
  for (const double tau : {-time, time}) {
    const std::vector<double> y = states.after(tau);
    for (std::size_t k = 0; k < y.size(); ++k)
      changes[k] = std::max(changes[k], std::abs(y[k] - states.y()[k]));
  }
  for (std::size_t k = 0; k < changes.size(); ++k) changes[k] = tried_first * changes[k] + (*errors)[k];
  return EventError{time, std::move(changes)};
}

std::optional<EventErrors::Time> EventErrors::time_of(const Watch& watch, Place& place, double shortest) {
  const double t = place.states.t();
  const double least = std::max({time_round_off(t), time_round_off(shortest), shortest_time});
  const Linear around = linear(watch, place);
  place.cancels = cancels(watch, place, around.doubt);
  const double guess = tried_first * around.doubt / std::abs(around.slope),
               farthest = farthest_share * place.own_time, value = std::abs(watch.value(t, place.states.y()));
  // At a pole no slope tells.
  const bool is_told =
      guess <= farthest && value <= std::abs(watch.value(t + guess, place.states.after(guess)));
  // It may lie beside the place by as much as values are rounded there.
  const bool is_rounded = value <= watch.own_rounding(t, place.states.y());
  bool has_one_sign = false;
  const double first = std::max(least, guess), begin = is_told && !watch.may_jump ? first : least;
  for (double tau = begin; tau <= farthest; tau *= tried_next) {
    const std::optional<int> before = sign_after(-tau, watch, place);
    const std::optional<int> after = before ? sign_after(tau, watch, place) : std::nullopt;
    if (after && *before != *after) {
      const bool has_slope = is_told && tau <= much_more * first && place.untold <= 2 * tau;
      return Time{tau + least, passes_once(std::max(tau, place.untold), watch, place) ||
                                   (has_slope && is_as_steep(tau, around.slope, watch, place))};
    }
    has_one_sign = has_one_sign || after;
    if (after && !is_rounded) break;
  }
  return has_one_sign ? std::nullopt : by_slopes(watch, place, around.doubt);
}

/// In the states that the motion may have within tau.
bool EventErrors::passes_once(double tau, const Watch& watch, Place& place) {
  const auto around = watch.passes_once ? place.states.around(tau) : std::nullopt;
  if (!around) return false;
  const double t = place.states.t();
  return watch.passes_once({Interval(t - tau, t + tau), around->y, around->rates});
}

/// Whether an enclosure of g is wider than what slopes tell.
bool EventErrors::cancels(const Watch& watch, const Place& place, double doubt) const {
  std::vector<Interval> box;
  const auto [y, errors] = std::pair(place.states.y(), std::span(place.states.errors()));
  for (std::size_t k = 0; k < y.size(); ++k) box.emplace_back(y[k] - errors[k], y[k] + errors[k]);
  return !(watch.enclosure(place.states.t(), box).radius() <= tried_first * doubt);
}

/// Whether g changes in some times tau about as its slope over larger distances says, or is rounded by as
/// much: a multiple root is flatter.
bool EventErrors::is_as_steep(double tau, double slope, const Watch& watch, Place& place) {
  const double some_times = seen_beside * tau;
  double change = 0, rounding = 0;
  for (const double length : {-some_times, some_times}) {
    const std::vector<double> y = place.states.after(length);
    const double t = place.states.t() + length;
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
std::optional<EventErrors::Time> EventErrors::by_slopes(const Watch& watch, Place& place, double doubt) {
  const double t = place.states.t(), farthest = farthest_share * place.own_time;
  for (double part = share; part <= farthest_share; part *= next_share) {
    const double tau = part * place.own_time;
    double rounding = 0;
    const auto g_after = [&](double length) {
      const std::vector<double> y = place.states.after(length);
      rounding = std::max(rounding, watch.own_rounding(t + length, y));
      return watch.value(t + length, y);
    };
    const double before = g_after(-tau), now = g_after(0), after = g_after(tau);
    const double slope = (std::abs(after - before) - 2 * rounding) / (2 * tau);
    const double curvature = (std::abs(after - 2 * now + before) + 4 * rounding) / (tau * tau);
    const double all = doubt + rounding, discriminant = slope * slope - 2 * curvature * all;
    if (!(slope > 0 && discriminant >= 0)) continue;
    const double first = 2 * all / (slope + std::sqrt(discriminant)) + time_round_off(t);
    double error = first;
    while (error <= farthest && !is_clear_of_zero(error, watch, place)) error *= tried_next;
    if (!(error <= farthest)) return std::nullopt;
    return Time{error, error <= much_more * first && place.untold <= 2 * error};
  }
  return std::nullopt;
}

/// Whether g has left zero by what it may be off there, to one side before and to the other after. At a
/// multiple root slopes over a longer time tell too much.
bool EventErrors::is_clear_of_zero(double tau, const Watch& watch, Place& place) {
  double before = 0;
  for (const double length : {-tau, tau}) {
    const std::vector<double> y = place.states.after(tried_first * length);
    const double t = place.states.t() + tried_first * length, value = watch.value(t, y);
    auto errors = place.states.errors_after(length);
    if (!errors) return false;
    const Place there{.states{dynamics_, workspace_, t_start_, t, y, *std::move(errors)},
                      .own_time = place.own_time};
    const double doubt = linear(watch, there).doubt - std::abs(value) + watch.own_rounding(t, y);
    if (!(std::abs(value) >= nearly_all * doubt)) return false;
    if (before != 0) return (before < 0) != (value < 0);
    before = value;
  }
  return false;
}

/// By slopes of g in each component.
EventErrors::Linear EventErrors::linear(const Watch& watch, const Place& place) const {
  const std::span<const double> y = place.states.y(), errors = place.states.errors();
  const double t = place.states.t();
  std::vector<double> moved(y.begin(), y.end());
  Linear result{.doubt = std::abs(watch.value(t, y)), .slope = 0};
  for (std::size_t k = 0; k < moved.size(); ++k) {
    const double h = std::max(errors[k], shortest_step * std::max(scale_[k], std::abs(y[k])));
    if (h == 0) continue;
    moved[k] = y[k] + h;
    const double beyond = watch.value(t, moved);
    moved[k] = y[k] - h;
    const double partial = (beyond - watch.value(t, moved)) / (2 * h);
    moved[k] = y[k];
    result.doubt += std::abs(partial) * errors[k];
    result.slope += partial * place.states.rate(k);
  }
  const double tau = std::max(shortest_step * place.own_time, seen_beside * time_round_off(t));
  const double later = watch.value(t + tau, y), earlier = watch.value(t - tau, y);
  if (std::isfinite(later - earlier)) result.slope += (later - earlier) / (2 * tau);
  return result;
}

/// Of g in all states that the motion may have then; none where both occur.
std::optional<int> EventErrors::sign_after(double tau, const Watch& watch, Place& place) {
  const auto box = place.states.box_after(tau);
  const int sign = box ? sign_within(watch, place.states.t() + tau, *box, place.cancels) : 0;
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

}  // namespace qdot
