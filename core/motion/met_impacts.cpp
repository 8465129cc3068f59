#include "core/motion/met_impacts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.hpp"
#include "core/motion/conditions_after_impact.hpp"
#include "core/motion/start_conditions.hpp"
#include "core/numerics/root.hpp"

namespace qdot {
namespace {

constexpr const char* accumulation =
    "The impacts follow each other faster and faster, and accumulate at this time. The last ones before it are left out "
    "of the events.";

constexpr const char* contact =
    "After this impact the bodies stay in contact, pressed together. The scene says nothing of motions in contact, so "
    "this one ends here.";

constexpr const char* hidden =
    "The impacts follow each other here in flights that are lower than the distance is rounded. Whether they come to an "
    "end is not known.";

const char* in_words(const RestOfImpacts& rest) {
  return std::isinf(rest.doubt) ? hidden : rest.in_contact ? contact : accumulation;
}

}  // namespace

MetImpacts::MetImpacts(RunningMotion& motion)
    : motion_(motion), impacts_(motion.dynamics, motion.request, motion.sections) {}

bool MetImpacts::record_events(const Run& done) {
  bool impact = false;
  ended_by_ = nullptr;
  impacts_.begin_instant();
  for (const EventOccurrence& occurrence : done.events) {
    if (occurrence.event >= motion_.sections.watches().size()) continue;  // a kink
    const Watch& watch = motion_.sections.watches()[occurrence.event];
    const bool last = done.ending == Ending::event && occurrence.t == done.t;
    if (watch.kind == Watch::Kind::event || watch.kind == Watch::Kind::impact) {
      motion_.record_event({watch.name, occurrence.t, occurrence.y, false, occurrence.untold});
      if (watch.kind != Watch::Kind::impact) continue;
      impact = true;
      impacts_.meet(occurrence.event);
    } else if (last && ended_by_ == nullptr && watch.kind != Watch::Kind::jump) {
      ended_by_ = &watch;
    }
  }
  if (ended_by_ != nullptr && !impact) motion_.stop_by(*ended_by_);
  return impact && !motion_.result.stop;
}

/// What an impact of the same instant turns the motion away from may lie behind it, and does where both are
/// one surface.
bool MetImpacts::ends_in_instant(const SectionRecord& impact) {
  if (ended_by_ == nullptr) return false;
  const EventSides& sides = motion_.sides;
  const Watch& met = impacts_.watches()[impact.impacts.front()];
  const bool is_left_alone =
      ended_by_->value(impact.t, impact.before) == ended_by_->value(impact.t, impact.after);
  const bool turns = is_left_alone && !sides.goes_through(*ended_by_, impact.t, impact.before, impact.after);
  if (!turns || ended_by_->kind != Watch::Kind::validity) {
    motion_.stop_by(*ended_by_);
  } else if (!sides.are_same_surface(*ended_by_, met, impact.t, impact.before)) {
    motion_.note_unclear();
  }
  return motion_.result.stop.has_value();
}

/// All impacts of this instant. Those that others have started become events here.
InstantImpacts::Passed MetImpacts::pass_instant() {
  InstantImpacts::Passed passed = impacts_.pass(motion_.result.t, motion_.result.y, motion_.sides);
  std::vector<bool> told(impacts_.watches().size());
  for (const auto& [impact, before] : passed.all) {
    if (told[impact] || !impacts_.has_met(impact))
      motion_.record_event(
          {motion_.dynamics.model().parsed.impacts[impact].event, motion_.result.t, before, false, 0});
    told[impact] = true;
  }
  if (passed.order_matters) doubt_order();
  if (passed.is_unclear) motion_.note_unclear();
  return passed;
}

void MetImpacts::doubt_order() {
  Simulation& result = motion_.result;
  if (!result.order_in_doubt) result.order_in_doubt = result.t;
  for (auto event = result.events.rbegin(); event != result.events.rend() && event->t == result.t; ++event)
    event->is_in_doubt = true;
}

/// Events of this instant, from which the impact has turned the motion away: they may be behind it.
void MetImpacts::doubt_events_beside(const SectionRecord& impact) {
  std::vector<EventRecord>& events = motion_.result.events;
  const std::vector<Watch>& watches = motion_.sections.watches();
  for (auto event = events.rbegin(); event != events.rend() && event->t == impact.t; ++event) {
    const auto watch = std::ranges::find(watches, event->name, &Watch::name);
    if (watch == watches.end() || watch->kind != Watch::Kind::event) continue;
    const Watch& met = impacts_.watches()[impact.impacts.front()];
    const bool is_certain = motion_.sides.goes_through(*watch, impact.t, impact.before, impact.after) ||
                            motion_.sides.are_same_surface(*watch, met, impact.t, impact.before);
    if (!is_certain) event->is_in_doubt = true;
  }
}

/// Whether the motion ends with the impacts of this instant, by what else is met there, by what was asked, or
/// by coming to rest.
bool MetImpacts::is_over(const InstantImpacts::Passed& passed) {
  Simulation& result = motion_.result;
  if (ends_in_instant(result.sections.back())) {
    result.ending = Ending::event;
    return true;
  }
  if (result.t >= motion_.request.t_end || result.sections.size() == motion_.request.end_after_impacts) {
    result.ending = Ending::reached_end;
    return true;
  }
  const auto rest = impacts_.rest(result.sections, passed, motion_.sides);
  if (!rest) return false;
  if (rest->in_contact) result.y = passed.after;
  const double accumulate_at = result.t + rest->time;
  result.t = std::min(accumulate_at, motion_.request.t_end);
  result.stop = Stop{impacts_accumulate, result.t, in_words(*rest), rest->doubt + accumulate_at - result.t};
  return true;
}

SectionEnd MetImpacts::ending(const InstantImpacts::Passed& passed) const {
  const Watch& first = impacts_.watches()[passed.all.front().impact];
  SectionEnd end = motion_.ending_by(first.value);
  end.rounding = first.own_rounding(motion_.result.t, motion_.result.y);
  end.map = [this, all = passed.all](double t, const std::vector<double>& y) {
    return impacts_.repeat(t, y, all);
  };
  return end;
}

bool MetImpacts::pass() {
  Simulation& result = motion_.result;
  const InstantImpacts::Passed passed = pass_instant();
  const double begin = result.sections.empty() ? motion_.request.t_start : result.sections.back().t;
  result.sections.push_back({result.t, result.t - begin, result.y, passed.after, {}});
  for (const auto& [impact, before] : passed.all) result.sections.back().impacts.push_back(impact);
  motion_.sides.pass(result.sections.back());
  doubt_events_beside(result.sections.back());
  if (is_over(passed)) return false;
  if (!keeps_constraints(motion_.dynamics, motion_.request, result.t, result.y, passed.after))
    throw Error(ErrorCode::invalid_state,
                "The state after an impact, as its map says, does not obey the constraints.");
  const Watch& first = impacts_.watches()[passed.all.front().impact];
  const double late = motion_.sides.late_at_begin(first, result.sections.back());
  SectionEnd end = ending(passed);
  result.y = passed.after;
  motion_.is_determined = motion_.sections.begin(result.t, result.y);
  if (!motion_.is_determined) return true;
  motion_.complete(end);
  doubt_instant(end, passed, std::max({time_round_off(end.t), passed.within, late}));
  motion_.apart.pass(std::move(end));
  motion_.apart.doubt(passed.rounding);
  motion_.doubt_kinks(motion_.sections.doubt_of_begin());
  if (motion_.request.notes_approaches)
    note_conditions(motion_.sections, motion_.apart.at_end(), motion_.unseen.so_far(), result);
  return true;
}

/// The motion may go on for so long as each of several impacts has left it.
void MetImpacts::doubt_instant(const SectionEnd& end, const InstantImpacts::Passed& passed, double late) {
  motion_.unseen.doubt_instant(end, late);
  SectionEnd between = end;
  between.map = nullptr;
  for (std::size_t i = 1; i < passed.all.size(); ++i) {
    between.after = passed.all[i].before;
    motion_.unseen.doubt_instant(between, late);
  }
}

}  // namespace qdot
