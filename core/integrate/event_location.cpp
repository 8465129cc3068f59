// Where in a step a function crosses zero, and whether it does so through a pole (events.hpp).

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/integrate/events.hpp"
#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

constexpr int halvings = 60;
constexpr double growth_at_pole = 3;
constexpr double widened = 256;  ///< times what a place is known to
constexpr double of_end = 16;    ///< roundings of what is zero where a value ceases to be

// At a pole values grow towards the place on both sides: at a jump they may be large, too, but no more so the
// nearer it is. [from, to] is the step.
template <class Function>
bool grows_towards(const Function& g, const SignChange& place, double from, double to) {
  const double shortest = std::max(place.after - place.before, time_round_off(place.after));
  const auto grows = [&](double value, double t, double distance) {
    const double beside = t + std::copysign(std::sqrt(shortest * std::abs(distance)), distance);
    return std::abs(distance) <= widened * shortest || std::abs(value) > growth_at_pole * std::abs(g(beside));
  };
  return to - from > shortest && grows(place.value_before, place.before, from - place.before) &&
         grows(place.value_after, place.after, to - place.after);
}

/// Where it has no value before, it has its old sign.
bool changes_sign(const SignChange& place) {
  const double before = place.value_before, after = place.value_after;
  return std::isnan(before) || (before < 0 && after > 0) || (before > 0 && after < 0);
}

/// At t_start g may be zero or have passed it by a rounding error, and at a step's beginning too, or not yet
/// have passed it at the end: then a part of [from, to], if g changes its sign in one.
template <class Function>
SignChange bracket_in(const Function& g, double from, double to) {
  SignChange bracket{from, g(from), to, g(to)};
  for (int k = 1; k <= halvings && !changes_sign(bracket); ++k) {
    bracket.before = from + std::ldexp(to - from, -k);
    bracket.value_before = g(bracket.before);
  }
  return bracket;
}

}  // namespace

/// What is left at t_start is taken from g where g alone has no bracket: else flight upon flight would end
/// where the one before has begun, and never at zero.
std::optional<double> EventSearch::locate(Stepper& stepper, const Crossed& crossed, Found& found) {
  const EventFunction& event = request_.events[crossed.event];
  double left = 0;
  const auto g = [&](double t) {
    if (!found.failure) found.failure = stepper.interpolate(t, y_);
    return found.failure ? std::numeric_limits<double>::quiet_NaN() : event.value(t, y_) - left;
  };
  const double end = std::min(crossed.after, stepper.t());
  SignChange place = bracket_in(g, crossed.before, end);
  if (left_at_start_[crossed.event] != 0 && !changes_sign(place)) {
    left = left_at_start_[crossed.event];
    place = bracket_in(g, crossed.before, end);
  }
  if (found.failure) return std::nullopt;
  if (changes_sign(place)) {
    place = find_sign_change(g, place);
  } else {
    const bool is_after =
        event.sign_at_start != 0 || std::abs(place.value_after) < std::abs(g(crossed.before));
    place.before = place.after = is_after ? end : crossed.before;
    place.value_before = place.value_after = g(place.after);
  }
  const bool is_of_g = event.sign_at_start == 0 || event.is_beside_zero;
  const double begin = polynomial_.whole().t;
  const bool passes_poles = is_of_g && !event.must_have_value;
  if (passes_poles && !is_bounded_around(crossed.event, place) && grows_towards(g, place, begin, stepper.t()))
    return std::nullopt;
  return place.after;
}

/// Whether g is bounded there, so that it crosses zero where its sign changes, however steeply.
bool EventSearch::is_bounded_around(std::size_t event, const SignChange& place) {
  const double begin = polynomial_.whole().t, h = polynomial_.whole().h;
  const double around = widened * std::max(place.after - place.before, time_round_off(place.after));
  const double from = std::max(0.0, place.before - around - begin),
               to = std::min(h, place.after + around - begin);
  return to > from && finite_series(event, polynomial_.piece(from, to - from)).is_finite();
}

/// Since the step's beginning. What ends the run because a value ceases to be there is rounded: by that the
/// value may have gone a little before.
double EventSearch::value_is_wanted_until(const Found& found) {
  if (!found.terminal) return infinity;
  const EventOccurrence& last = found.events.back();
  const EventFunction& event = request_.events[last.event];
  const double begin = polynomial_.whole().t, at = last.t - begin;
  if (!event.must_have_value || !event.rounding) return at;
  const double hidden = of_end * event.rounding(last.t, last.y);
  double before = time_round_off(last.t);
  while (before < at && std::abs(value_at(last.event, last.t - before)) <= hidden) before *= 2;
  return at - std::min(before, at);
}

/// On the step's polynomial.
double EventSearch::value_at(std::size_t event, double t) {
  const MotionPiece there = polynomial_.piece(t - polynomial_.whole().t, polynomial_.whole().h);
  for (std::size_t i = 0; i < y_.size(); ++i) y_[i] = there.rows[i * (there.order + 1)];
  return request_.events[event].value(t, y_);
}

/// Of an event that is reported only.
bool EventSearch::is_pole_between(std::size_t event, double from, double to) {
  if (request_.events[event].terminal) return false;
  const double begin = polynomial_.whole().t, h = polynomial_.whole().h;
  const auto g = [&](double t) { return value_at(event, t); };
  const double before = begin + from, after = begin + to;
  const SignChange place{before, g(before), after, g(after)};
  return !is_bounded_around(event, place) && grows_towards(g, place, begin, begin + h);
}

}  // namespace qdot
