#include "core/motion/impacts_along.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/pressing.hpp"
#include "core/motion/unseen_flights.hpp"

namespace qdot {
namespace {

constexpr double short_flight = 1e-2;      ///< of the longest
constexpr double moment_of_flight = 1e-6;  ///< in which a speed is measured
constexpr double of_twice = 0.1;           ///< where rounding is larger than a way, its double is another
constexpr double no_speed = 1e-5;          ///< of that before an impact

}  // namespace

ImpactsAlong::ImpactsAlong(const Dynamics& dynamics, const SimulationRequest& request,
                           const MotionSections& sections)
    : dynamics_(dynamics), request_(request), sections_(sections) {}

void ImpactsAlong::begin_instant() { met_.assign(dynamics_.model().parsed.impacts.size(), false); }

void ImpactsAlong::meet(std::size_t watch) { met_[watch + met_.size() - sections_.watches().size()] = true; }

std::span<const Watch> ImpactsAlong::watches() const {
  return std::span(sections_.watches()).last(dynamics_.model().parsed.impacts.size());
}

InstantImpacts::Passed ImpactsAlong::pass(double t, const std::vector<double>& y, const EventSides& sides) {
  if (!impacts_) impacts_.emplace(dynamics_, request_.parameters, sections_.resolution());
  return impacts_->pass(t, y, met_, watches(), sides, request_.impact_order);
}

std::optional<RestOfImpacts> ImpactsAlong::rest(std::span<const SectionRecord> sections,
                                                const InstantImpacts::Passed& passed,
                                                const EventSides& sides) {
  const SectionRecord& last = sections.back();
  if (sections[longest_].duration < last.duration) longest_ = sections.size() - 1;
  if (passed.is_over && is_pressed_on(passed.all.back().impact, last, sides))
    return RestOfImpacts{0, unseen_time(passed.all.back().impact, sections, sides), true};
  const std::size_t first = passed.all.front().impact;
  const double lowest = lowest_flight(first, sections);
  auto rest = passed.is_over ? rest_of_impacts(sections, request_.t_end - request_.t_start, lowest)
                             : RestOfImpacts{0, doubt_of_lost(sections, lowest), false};
  if (!rest) rest = rest_of_hidden(watches()[first], sections);
  if (!rest) return rest;
  const bool is_at_end = passed.is_over && rest->time == 0;
  const double unseen = is_at_end ? unseen_time(first, sections, sides) : sections_.resolution();
  rest->in_contact = is_at_end && leaves_contact(first, sections);
  rest->doubt = rest->in_contact ? unseen : rest->doubt + unseen;
  return rest;
}

/// Since the impact that was seen last, and in flights that rounding hides after it.
double ImpactsAlong::unseen_time(std::size_t impact, std::span<const SectionRecord> sections,
                                 const EventSides& sides) const {
  const SectionRecord &seen = last_seen(watches()[impact], sections), &last = sections.back();
  return sections_.resolution() + last.t - seen.t + unseen_flights(impact, seen, last, sides);
}

/// How long the flights take that rounding hides, after the impact that was seen last; for ever where they do
/// not shrink, as the last impact tells.
double ImpactsAlong::unseen_flights(std::size_t impact, const SectionRecord& seen, const SectionRecord& last,
                                    const EventSides& sides) const {
  const Watch& watch = watches()[impact];
  const UnseenFlights flights(sections_, sides, request_.t_end - request_.t_start);
  const std::optional<double> e = impacts_->restitution(impact);
  if (!e) {
    UnseenFlights::Left left = flights.by_map(watch, seen);
    if (left.rate > 0 && &seen != &last) left.ratio = flights.by_map(watch, last).ratio;
    return flights.duration(watch, seen, left);
  }
  if (*e == 0) return flights.duration(watch, seen, {});
  const std::optional<double> hidden = impacts_->hidden_rate(impact, seen.t, seen.after);
  const double rate = hidden ? *hidden : std::abs(sides.rate(watch, seen.t, seen.after).value);
  return flights.duration(watch, seen, {rate, hidden && *e == 1 ? 0 : *e});
}

/// Whether the impact has left its distance no rate beyond rounding, and the forces lead behind the surface.
bool ImpactsAlong::is_pressed_on(std::size_t impact, const SectionRecord& last,
                                 const EventSides& sides) const {
  const Watch& watch = watches()[impact];
  const double span = request_.t_end - request_.t_start;
  const bool leaves_no_rate = impacts_->restitution(impact)
                                  ? impacts_->leaves_no_rate(impact, last.t, last.after)
                                  : UnseenFlights(sections_, sides, span).by_map(watch, last).rate == 0;
  if (watch.direction == Crossing::either || !leaves_no_rate) return false;
  return sides.is_sharp(watch, last) && pressing(watch, last, sections_, span) > 0;
}

/// Whether the last impact after a flight took all speed from the distance, as far as rounding lets that be
/// seen, or there was none.
bool ImpactsAlong::leaves_contact(std::size_t impact, std::span<const SectionRecord> sections) const {
  const double span = request_.t_end - request_.t_start;
  std::size_t last = sections.size() - 1;
  while (last > 0 && !(sections[last].duration > short_flight * sections[longest_].duration)) --last;
  const SectionRecord& hit = sections[last];
  const double tau = moment_of_flight * (hit.duration > 0 ? hit.duration : span);
  const auto way = [&](std::vector<double> y, double time) {
    const double now = watches()[impact].value(hit.t, y);
    const std::size_t n = y.size() / 2;
    for (std::size_t i = 0; i < n; ++i) y[i] += time * y[n + i];
    return std::abs(watches()[impact].value(hit.t + time, y) - now);
  };
  const double before = way(hit.before, tau), twice = way(hit.before, 2 * tau);
  const bool is_seen = hit.duration == 0 || (before > 0 && std::abs(twice - 2 * before) <= of_twice * before);
  return is_seen && way(hit.after, tau) <= no_speed * before;
}

/// How short a flight may be before the distance is rounded as much as it is high.
double ImpactsAlong::lowest_flight(std::size_t impact, std::span<const SectionRecord> sections) const {
  const SectionRecord& longest = sections[longest_];
  const SectionRecord& last = sections.back();
  if (last.duration > short_flight * longest.duration) return 0;
  return qdot::lowest_flight(watches()[impact], longest, sections_.slopes(last.t, longest.before), last);
}

}  // namespace qdot
