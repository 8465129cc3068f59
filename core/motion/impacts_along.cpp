#include "core/motion/impacts_along.hpp"

#include <algorithm>

namespace qdot {
namespace {

constexpr double short_flight = 1e-2;  ///< of the longest

}  // namespace

ImpactsAlong::ImpactsAlong(const Dynamics& dynamics, const SimulationRequest& request,
                           const MotionSections& sections)
    : dynamics_(dynamics), request_(request), sections_(sections) {}

void ImpactsAlong::begin_instant() { met_.assign(dynamics_.model().parsed.impacts.size(), false); }

void ImpactsAlong::meet(std::size_t watch) { met_[watch + met_.size() - sections_.watches().size()] = true; }

std::span<const Watch> ImpactsAlong::watches() const {
  return std::span(sections_.watches()).last(dynamics_.model().parsed.impacts.size());
}

InstantImpacts::Passed ImpactsAlong::pass(double t, const std::vector<double>& y) {
  if (!impacts_) impacts_.emplace(dynamics_, request_.parameters, sections_.resolution());
  return impacts_->pass(t, y, met_, watches(), request_.impact_order);
}

std::optional<RestOfImpacts> ImpactsAlong::rest(std::span<const SectionRecord> sections,
                                                const InstantImpacts::Passed& passed) {
  if (sections[longest_].duration < sections.back().duration) longest_ = sections.size() - 1;
  const double lowest = lowest_flight(passed.all.front().impact, sections);
  auto rest = passed.is_over ? rest_of_impacts(sections, request_.t_end - request_.t_start, lowest)
                             : RestOfImpacts{0, doubt_of_lost(sections, lowest)};
  if (rest) rest->doubt += sections_.resolution();
  return rest;
}

/// How short a flight may be before the distance is rounded as much as it is high.
double ImpactsAlong::lowest_flight(std::size_t impact, std::span<const SectionRecord> sections) const {
  const SectionRecord& longest = sections[longest_];
  const SectionRecord& last = sections.back();
  if (last.duration > short_flight * longest.duration) return 0;
  return qdot::lowest_flight(watches()[impact], longest, sections_.slopes(last.t, longest.before), last);
}

}  // namespace qdot
