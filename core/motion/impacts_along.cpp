#include "core/motion/impacts_along.hpp"

#include <algorithm>
#include <cmath>

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
                                                const InstantImpacts::Passed& passed) {
  if (sections[longest_].duration < sections.back().duration) longest_ = sections.size() - 1;
  const double lowest = lowest_flight(passed.all.front().impact, sections);
  auto rest = passed.is_over ? rest_of_impacts(sections, request_.t_end - request_.t_start, lowest)
                             : RestOfImpacts{0, doubt_of_lost(sections, lowest), false};
  if (!rest) rest = rest_of_hidden(watches()[passed.all.front().impact], sections);
  if (!rest) return rest;
  if (passed.is_over && rest->time == 0 && leaves_contact(passed.all.front().impact, sections))
    rest = RestOfImpacts{0, 0, true};
  rest->doubt += sections_.resolution();
  return rest;
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
