#include "core/motion/event_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/motion/accumulation.hpp"
#include "core/motion/row_errors.hpp"
#include "core/numerics/same_bits.hpp"

namespace qdot {
namespace {

constexpr double small_beside = 1e-3;  ///< of a column: there errors grow as linear ones do

/// Rows may meet an oscillation always in the same phase, where the error of a coordinate is small and that
/// of its velocity large, or the other way round: between them each turns into the other.
std::vector<double> between_rows(std::span<const double> error, std::span<const double> scale) {
  std::vector<double> result(error.begin(), error.end());
  const std::size_t n = scale.size() / 2;
  for (std::size_t i = 0; i < n; ++i) {
    const double tau = scale[i] / scale[n + i];
    if (!(tau > 0) || !std::isfinite(tau)) continue;
    result[i] = hypotenuse(error[i], tau * error[n + i]);
    result[n + i] = hypotenuse(error[i] / tau, error[n + i]);
  }
  return result;
}

}  // namespace

const Simulation& computation_that_tells(const ComputedMotion& motion, std::span<const Simulation> others) {
  const auto knows =
      std::ranges::find_if(others, [](const Simulation& s) { return !s.apart_at_end.empty(); });
  return knows == others.end() ? motion.simulation : *knows;
}

EventComparison::EventComparison(const ComputedMotion& motion, const std::vector<Simulation>& others,
                                 const ErrorsOfRows& errors, RowsAtImpacts& at_impacts)
    : motion_(motion),
      others_(others),
      errors_(errors),
      scale_(errors.scale),
      at_events_(motion, others, scale_, at_impacts),
      of_state_(motion.dynamics, motion.request, scale_),
      reached_(scale_.size()) {}

std::vector<std::optional<EventError>> EventComparison::of_events() {
  std::vector<std::optional<EventError>> result;
  const EventRecord* last = nullptr;
  for (const EventRecord& event : motion_.simulation.events) {
    const auto [errors, are_of_it] = errors_at(event);
    result.push_back(errors.empty() || event.is_in_doubt
                         ? std::nullopt
                         : of_state_.of(event, errors, are_of_it ? std::span(reached_) : scale_));
    if (last != nullptr && last->t == event.t) share_with_cause(result);
    if (last != nullptr && last->t == event.t && last->name == event.name && !is_impact(event.name)) {
      result.back().reset();  // zeros that are too near to each other for times of their own
      result[result.size() - 2].reset();
    }
    last = &event;
  }
  doubt_neighbours(result);
  return result;
}

/// Of one name within the error of each other: rounding may have made several of one.
void EventComparison::doubt_neighbours(std::vector<std::optional<EventError>>& errors) const {
  std::map<std::string, std::size_t> last;
  const std::vector<EventRecord>& events = motion_.simulation.events;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const auto [place, is_first] = last.try_emplace(events[i].name, i);
    const std::size_t before = std::exchange(place->second, i);
    if (is_first || !errors[before] || !errors[i]) continue;
    const double apart = events[i].t - events[before].t;
    if (apart <= std::max(errors[before]->time, errors[i]->time))
      errors[before]->is_single = errors[i]->is_single = false;
  }
}

bool EventComparison::is_impact(const std::string& name) const {
  const std::vector<ParsedImpact>& impacts = motion_.dynamics.model().parsed.impacts;
  return std::ranges::find(impacts, name, &ParsedImpact::event) != impacts.end();
}

/// What happens at the instant of another event may follow from it, as one impact from another.
void EventComparison::share_with_cause(std::vector<std::optional<EventError>>& errors) {
  const auto& cause = errors[errors.size() - 2];
  auto& own = errors.back();
  if (!cause) own.reset();
  if (!own) return;
  own->time = std::max(own->time, cause->time);
  for (std::size_t k = 0; k < own->state.size(); ++k)
    own->state[k] = std::max(own->state[k], cause->state[k]);
}

std::vector<ApproachAsTold> EventComparison::approaches() {
  std::vector<ApproachAsTold> all;
  const Simulation& tells = computation_that_tells(motion_, others_);
  for (const ApproachRecord& approach : tells.approaches) {
    if (&tells == &motion_.simulation) {
      add_told(approach, all);
    } else {
      StateAsTold told{std::vector<double>(scale_.size()), approach.place.apart};
      for (double& error : told.errors) error *= safety_of_differences;
      for (std::size_t k = 0; k < approach.place.unseen.size(); ++k)
        told.errors[k] += approach.place.unseen[k];
      all.push_back({approach, std::move(told), rows_before(approach.place.instant())});
    }
  }
  return all;
}

std::vector<ApproachAsTold> EventComparison::near_events() {
  std::vector<ApproachAsTold> all;
  for (const ApproachRecord& approach : motion_.simulation.near_events) {
    if (!is_passed_against(approach)) add_told(approach, all);
  }
  return all;
}

/// A step of its function, such as that of tanh, at which the event is passed the other way.
bool EventComparison::is_passed_against(const ApproachRecord& approach) {
  const Approach& place = approach.place;
  if (!place.is_hidden || place.others) return false;
  const EventRecord event{approach.name, place.t, place.state_at(0)};
  const auto [errors, are_of_it] = errors_at(event);
  return of_state_.passes_against(event, errors, are_of_it ? std::span(reached_) : scale_);
}

/// Of the motion's own. Others tell of an instant what is before all its impacts.
void EventComparison::add_told(const ApproachRecord& approach, std::vector<ApproachAsTold>& all) {
  const double t = approach.place.instant();
  const EventRecord event{approach.name, t, approach.place.state_at(t - approach.place.t)};
  auto [errors, are_of_it] = errors_at(event);
  const bool is_after_impact = t == approach.begun;
  if (is_after_impact) errors = some_rows_after(t);
  std::vector<StateAsTold> told;
  if (are_of_it && !is_after_impact) told = at_events_.as_told(event);
  if (told.empty() && !errors.empty())
    told.push_back({std::vector<double>(event.y.size()), std::move(errors)});
  if (approach.place.others) widen_for_others(*approach.place.others, told);
  for (StateAsTold& state : told) all.push_back({approach, std::move(state), rows_before(t)});
}

/// The last of them has the largest errors.
void EventComparison::widen_for_others(const Approach::Others& others, std::vector<StateAsTold>& told) const {
  if (rows() == 0 || others.from > motion_.grid.t[rows() - 1]) return;
  const std::vector<double> last = some_rows_after(std::min(others.to, motion_.grid.t[rows() - 1]));
  if (told.empty()) told.push_back({std::vector<double>(last.size()), last});
  for (StateAsTold& state : told) {
    for (std::size_t k = 0; k < last.size(); ++k) state.errors[k] = std::max(state.errors[k], last[k]);
  }
}

EventComparison::OfState EventComparison::errors_at(const EventRecord& event) {
  const std::vector<double> before = rows_before(event.t);
  const auto at_event = at_events_.next(event, before);
  if (at_event && is_small(*at_event)) return {*at_event, true};
  return {some_rows_after(event.t), false};
}

std::span<const double> EventComparison::row(std::size_t i) const {
  return std::span(errors_.stated).subspan(i * scale_.size(), scale_.size());
}

/// The errors of the last row before t. Times do not fall.
std::vector<double> EventComparison::rows_before(double t) {
  const std::vector<double>& times = motion_.grid.t;
  const std::span<const double> states = motion_.simulation.states;
  const auto note = [&](std::size_t i) {
    for (std::size_t k = 0; k < scale_.size(); ++k)
      reached_[k] = std::max(reached_[k], std::abs(states[i * scale_.size() + k]));
  };
  while (next_row_ < rows() && times[next_row_] <= t) note(next_row_++);
  if (next_row_ < rows()) note(next_row_);
  if (next_row_ > 0) return {row(next_row_ - 1).begin(), row(next_row_ - 1).end()};
  std::vector<double> none(scale_.begin(), scale_.end());
  for (double& error : none) error *= errors_.doubt;
  return none;
}

/// Where the others have no state at an event, or the motion is lost: the first rows may be small by chance.
std::vector<double> EventComparison::some_rows_after(double t) const {
  const auto times = std::span(motion_.grid.t).first(rows());
  if (times.empty() || t > times.back()) return {};
  const auto later = std::ranges::lower_bound(times, t + own_time()) - times.begin();
  return between_rows(row(std::min(static_cast<std::size_t>(later), rows() - 1)), scale_);
}

/// The longest L_q / L_v: in which the motion may go once through a column.
double EventComparison::own_time() const {
  double time = 0;
  for (std::size_t i = 0; i < scale_.size() / 2; ++i) {
    const double tau = scale_[i] / scale_[scale_.size() / 2 + i];
    if (std::isfinite(tau)) time = std::max(time, tau);
  }
  return time;
}

bool EventComparison::is_small(std::span<const double> errors) const {
  for (std::size_t k = 0; k < errors.size(); ++k) {
    if (!(errors[k] <= small_beside * scale_[k])) return false;
  }
  return true;
}

/// The last impacts are as near to each other as their errors: those before them tell. None where none does.
std::optional<double> EventComparison::accumulation_error(std::span<const double> of_state) {
  const Simulation& motion = motion_.simulation;
  std::optional<double> of_impacts;
  std::vector<double> reached(scale_.begin(), scale_.end());  // there may be no row after the first
  for (const EventRecord& event : motion.events) {
    for (std::size_t k = 0; k < reached.size(); ++k) reached[k] = std::max(reached[k], std::abs(event.y[k]));
  }
  for (const EventRecord& event : motion.events) {
    const auto own = of_state_.of(event, of_state, reached);
    if (own) of_impacts = std::max(of_impacts.value_or(0), own->time);
  }
  return of_impacts ? std::optional(*of_impacts + motion.stop->doubt) : std::nullopt;
}

/// The computations have each its own; they may agree by chance, and the last row is before all of them.
std::optional<EventError> EventComparison::of_stop() {
  if (!motion_.simulation.stop || rows() == 0) return std::nullopt;
  const Stop& stop = *motion_.simulation.stop;
  const std::vector<double> of_rows = some_rows_after(motion_.grid.t[rows() - 1]);
  std::vector<double> of_state = of_rows;
  std::optional<double> error;
  const bool accumulates = stop.reason == impacts_accumulate;
  for (const Simulation& other : others_) {
    if (!other.stop || other.stop->reason != stop.reason) continue;  // that in more digits has rows alone
    for (std::size_t k = 0; k < of_state.size(); ++k) {
      const double own = other.apart_at_end.empty() ? 0 : other.apart_at_end[k];
      const double apart = accumulates ? 0 : std::abs(other.y[k] - motion_.simulation.y[k]);
      of_state[k] = std::max(of_state[k], safety_of_differences * (own + apart));
    }
    error = std::max(error.value_or(0), safety_of_differences * std::abs(other.stop->t - stop.t));
  }
  if (!error) return std::nullopt;
  const std::vector<SectionRecord>& impacts = motion_.simulation.sections;
  const bool is_broken =
      !impacts.empty() && impacts.back().t == stop.t && of_state_.breaks(impacts.back(), stop, of_state);
  auto least = accumulates ? of_accumulation(of_state, of_rows)
               : is_broken ? of_breaking_impact(of_state, *error)
                           : of_state_.of(stop, motion_.simulation.y, of_state, *error);
  if (!least || !std::isfinite(least->time)) return std::nullopt;
  least->time = std::max(least->time, *error);
  return least;
}

/// What an impact breaks by far ends when the impact happens.
std::optional<EventError> EventComparison::of_breaking_impact(std::span<const double> of_state,
                                                              double at_least) {
  const Simulation& motion = motion_.simulation;
  for (const std::size_t impact : motion.sections.back().impacts) {
    const std::string& name = motion_.dynamics.model().parsed.impacts[impact].event;
    const auto event =
        std::ranges::find_if(motion.events.rbegin(), motion.events.rend(),
                             [&](const EventRecord& e) { return e.name == name && e.t == motion.stop->t; });
    if (event == motion.events.rend() || event->is_in_doubt) return std::nullopt;
    const auto own = of_state_.of(*event, of_state, scale_);
    if (!own) return std::nullopt;
    at_least = std::max(at_least, own->time);
  }
  return of_state_.at(motion.stop->t, motion.y, of_state, at_least);
}

/// Flights may be shorter than the errors of their impacts.
std::optional<EventError> EventComparison::of_accumulation(std::span<const double> of_state,
                                                           std::span<const double> of_rows) {
  auto time = accumulation_error(of_state);
  if (!time) time = accumulation_error(of_rows);
  return time ? std::optional(EventError{*time, {}}) : std::nullopt;
}

}  // namespace qdot
