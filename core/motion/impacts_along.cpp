#include "core/motion/impacts_along.hpp"

#include <algorithm>
#include <cmath>

namespace qdot {
namespace {

constexpr double short_flight = 1e-2;      ///< of the longest
constexpr double moment_of_flight = 1e-6;  ///< in which a speed is measured
constexpr double of_twice = 0.1;           ///< where rounding is larger than a way, its double is another
constexpr double no_speed = 1e-5;          ///< of that before an impact
constexpr double longest_of_looks = 0.5;   ///< of the motion's span
constexpr double next_of_looks = 4, roundings_of_look = 64;

/// After that time with these accelerations.
std::vector<double> moved(std::vector<double> y, std::span<const double> accelerations, double time) {
  const std::size_t n = y.size() / 2;
  for (std::size_t i = 0; i < n; ++i) {
    y[i] += time * (y[n + i] + time / 2 * accelerations[i]);
    y[n + i] += time * accelerations[i];
  }
  return y;
}

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
  if (sections[longest_].duration < sections.back().duration) longest_ = sections.size() - 1;
  if (passed.is_over && is_pressed_on(passed.all.back().impact, sections.back(), sides))
    return RestOfImpacts{0, sections_.resolution(), true};
  const double lowest = lowest_flight(passed.all.front().impact, sections);
  auto rest = passed.is_over ? rest_of_impacts(sections, request_.t_end - request_.t_start, lowest)
                             : RestOfImpacts{0, doubt_of_lost(sections, lowest), false};
  if (!rest) rest = rest_of_hidden(watches()[passed.all.front().impact], sections);
  if (!rest) return rest;
  if (passed.is_over && rest->time == 0 && leaves_contact(passed.all.front().impact, sections))
    rest = RestOfImpacts{0, 0, true};
  rest->doubt += sections_.resolution() + duration_of_hidden(watches()[passed.all.front().impact], sections);
  return rest;
}

/// Whether the impact has left its distance no rate but for rounding, and the forces lead behind the surface:
/// soon they have led there by more than rounding, those of then as well as those of now.
bool ImpactsAlong::is_pressed_on(std::size_t impact, const SectionRecord& last,
                                 const EventSides& sides) const {
  const Watch& watch = watches()[impact];
  const std::optional<double> rate = impacts_->hidden_rate(impact, last.t, last.after);
  if (!rate || watch.direction == Crossing::either || !sides.is_sharp(watch, last)) return false;
  const double longest = longest_of_looks * (request_.t_end - request_.t_start);
  const std::vector<double> now = sections_.slopes(last.t, last.after);
  const std::size_t n = now.size() / 2;
  for (double tau = sections_.resolution(); tau < longest; tau *= next_of_looks) {
    const std::vector<double> y = moved(last.after, std::span(now).last(n), tau);
    const double g = watch.value(last.t + tau, y);
    const double hidden = roundings_of_look * watch.own_rounding(last.t + tau, y) + 2 * *rate * tau;
    if (!(std::abs(g) > hidden)) continue;
    const std::vector<double> then = sections_.slopes(last.t + tau, y);
    const double by_then = watch.value(last.t + tau, moved(last.after, std::span(then).last(n), tau));
    const double inside = watch.direction == Crossing::falling ? -1 : 1;
    return inside * g > 0 && inside * by_then > 0;
  }
  return false;
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
