#include "core/integrate/events.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace qdot {
namespace {

int sign_of(double value) { return (value > 0) - (value < 0); }

// Zeros as near as this were found apart by round-off only.
bool same_instant(double t, double later) { return later - t <= 16 * time_round_off(later); }

// At a pole both sides outgrow what the bracket began with; at a zero or a jump they do not.
bool is_pole(const SignChange& begin, const SignChange& end) {
  const double bound = std::max(std::abs(begin.value_before), std::abs(begin.value_after));
  return std::abs(end.value_before) > bound && std::abs(end.value_after) > bound;
}

}  // namespace

EventSearch::EventSearch(const RunRequest& request)
    : request_(request), first_time_(request.t_start), y_(request.y_start.size()) {
  for (const EventFunction& event : request.events) {
    const double value = event.value(request.t_start, request.y_start);
    probes_.push_back({value, sign_of(value)});
  }
}

EventSearch::Found EventSearch::search(Stepper& stepper) {
  Found found;
  if (probes_.empty() || is_quiet(stepper)) return found;
  const double begin = stepper.t_previous();
  const double length = stepper.t() - begin;
  if (begin == request_.t_start) first_time_ = begin + std::max(1e-9 * length, 16 * time_round_off(begin));
  double from = begin;
  for (int i = 1; i <= pieces && !found.terminal && !found.failure; ++i) {
    const double to = i == pieces ? stepper.t() : begin + length * i / pieces;
    search_piece(stepper, from, to, found);
    from = to;
  }
  return found;
}

// Quiet: one strict sign throughout, and never as near to zero as an eighth
// of the way from one place to the next.
bool EventSearch::is_quiet(Stepper& stepper) {
  const double begin = stepper.t_previous();
  const double length = stepper.t() - begin;
  std::vector<double> last;
  for (const Probe& probe : probes_) last.push_back(probe.value);
  for (int k = 1; k <= pieces; ++k) {
    const double t = k == pieces ? stepper.t() : begin + length * k / pieces;
    if (k == pieces) {
      std::ranges::copy(stepper.y(), y_.begin());
    } else if (stepper.sketch(t, y_)) {
      return false;
    }
    for (std::size_t i = 0; i < probes_.size(); ++i) {
      const double value = request_.events[i].value(t, y_);
      const bool near = !(8 * std::min(std::abs(value), std::abs(last[i])) > std::abs(value - last[i]));
      if (near || sign_of(value) != probes_[i].sign) return false;
      last[i] = value;
    }
  }
  for (std::size_t i = 0; i < probes_.size(); ++i) probes_[i].value = last[i];
  return true;
}

void EventSearch::search_piece(Stepper& stepper, double from, double to, Found& found) {
  std::vector<double> y_to(y_.size());
  found.failure = stepper.interpolate(to, y_to);
  std::vector<std::pair<double, std::size_t>> zeros;
  for (std::size_t i = 0; i < probes_.size() && !found.failure; ++i) {
    const EventFunction& event = request_.events[i];
    const double value = event.value(to, y_to);
    const double value_from = probes_[i].value;
    if (!crosses(event, probes_[i], value)) continue;
    const auto t = locate(stepper, event, {from, value_from, to, value}, found);
    if (t && *t > first_time_) zeros.emplace_back(*t, i);
  }
  if (!found.failure) report(stepper, std::move(zeros), found);
}

bool EventSearch::crosses(const EventFunction& event, Probe& probe, double value) {
  if (std::isnan(value)) return false;
  const int sign = sign_of(value);
  const bool crossed = sign * probe.sign < 0;
  probe = {value, sign == 0 ? probe.sign : sign};
  return crossed &&
         (event.direction == Crossing::either || (event.direction == Crossing::rising) == (sign > 0));
}

// A probe that was exactly zero is the place: g had its old sign before and has the new one after.
std::optional<double> EventSearch::locate(Stepper& stepper, const EventFunction& event, SignChange bracket,
                                          Found& found) {
  if (bracket.value_before == 0) return bracket.before;
  const auto g = [&](double t) {
    if (!found.failure) found.failure = stepper.interpolate(t, y_);
    return found.failure ? std::numeric_limits<double>::quiet_NaN() : event.value(t, y_);
  };
  const SignChange place = find_sign_change(g, bracket);
  if (is_pole(bracket, place)) return std::nullopt;
  return place.after;
}

void EventSearch::report(Stepper& stepper, std::vector<std::pair<double, std::size_t>> zeros, Found& found) {
  std::ranges::sort(zeros);
  for (auto first = zeros.begin(); first != zeros.end() && !found.terminal && !found.failure;) {
    auto last = first + 1;
    while (last != zeros.end() && same_instant((last - 1)->first, last->first)) ++last;
    const double t = (last - 1)->first;
    std::sort(first, last, [](const auto& a, const auto& b) { return a.second < b.second; });
    found.failure = stepper.interpolate(t, y_);
    for (; first != last && !found.failure; ++first) {
      const EventFunction& event = request_.events[first->second];
      if (event.condition && !event.condition(t, y_)) continue;
      found.events.push_back({first->second, t, y_});
      found.terminal = found.terminal || event.terminal;
    }
  }
}

}  // namespace qdot
