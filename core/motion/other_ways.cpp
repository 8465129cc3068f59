#include "core/motion/other_ways.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "core/integrate/events.hpp"
#include "core/motion/accuracy_reasons.hpp"
#include "core/motion/fork.hpp"
#include "core/motion/instant_impacts.hpp"
#include "core/motion/simulation.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_ways = 16;
constexpr Tolerances of_checks{1e-12, 1e-15};
constexpr double much_larger = 10;  ///< errors than without
constexpr double widened = 2;  ///< times how early another way begins before a place: so long after it, too

/// As another computation of the motion, from its first row on.
class OtherWay {
 public:
  OtherWay(const ComputedMotion& motion, double begin, ImpactOrder order = ImpactOrder::of_scene)
      : motion_(motion), begin_(begin), order_(order) {
    const std::vector<double>& all = motion.event_rows.instants();
    first_ = static_cast<std::size_t>(std::ranges::lower_bound(all, begin) - all.begin());
  }

  Simulation from(std::vector<double> y, std::uint64_t evaluations_left) {
    const SimulationRequest request = request_from(std::move(y), evaluations_left);
    Simulation way = simulate(motion_.dynamics, request);
    spent_ = way.evaluations;
    const std::vector<double> before = rows_before();
    way.states.insert(way.states.begin(), before.begin(), before.end());
    way.rows += first_;
    way.unseen.clear();  // of what is computed there, which is one of many other ways
    const auto later = std::ranges::lower_bound(motion_.simulation.sections, begin_, {}, &SectionRecord::t);
    way.sections.insert(way.sections.begin(), motion_.simulation.sections.begin(), later);
    motion_.event_rows.set_apart(way, motion_.width());
    return way;
  }

  [[nodiscard]] std::uint64_t spent() const { return spent_; }

 private:
  [[nodiscard]] SimulationRequest request_from(std::vector<double> y, std::uint64_t evaluations_left) const {
    SimulationRequest request = motion_.request;
    request.t_start = begin_;
    request.t_start_left_out = 0;
    request.y_start = y;
    const std::vector<double>& all = motion_.event_rows.instants();
    request.grid.assign(all.begin() + static_cast<std::ptrdiff_t>(first_), all.end());
    request.grid_left_out.clear();
    request.columns.clear();
    request.events.clear();
    request.end_after_impacts.reset();
    request.impact_order = order_;
    request.method = motion_.is_stiff ? Method::bdf : Method::taylor;
    request.tolerances = request.method == motion_.simulation.method ? motion_.tolerances : of_checks;
    request.limits.max_evaluations = std::min(request.limits.max_evaluations, evaluations_left);
    return request;
  }

  /// The motion's own.
  [[nodiscard]] std::vector<double> rows_before() const {
    const std::size_t width = motion_.width();
    std::vector<double> rows;
    std::size_t row = 0;
    for (std::size_t i = 0; i < first_; ++i) {
      if (motion_.event_rows.is_row(i)) {
        const auto own = std::span(motion_.simulation.states).subspan(row++ * width, width);
        rows.insert(rows.end(), own.begin(), own.end());
      } else {
        const std::vector<double> own = state_at(motion_.event_rows.instants()[i]);
        rows.insert(rows.end(), own.begin(), own.end());
      }
    }
    return rows;
  }

  /// At an event or an approach.
  [[nodiscard]] std::vector<double> state_at(double t) const {
    const auto& events = motion_.simulation.events;
    const auto event = std::ranges::find(events, t, &EventRecord::t);
    if (event != events.end()) return event->y;
    const auto instant = [](const ApproachRecord& a) { return a.place.instant(); };
    const auto& near_events = motion_.simulation.near_events;
    auto approach = std::ranges::find(motion_.simulation.approaches, t, instant);
    if (approach == motion_.simulation.approaches.end())
      approach = std::ranges::find(near_events, t, instant);
    return approach->place.state_at(t - approach->place.t);
  }

  const ComputedMotion& motion_;
  double begin_;
  ImpactOrder order_;
  std::size_t first_{};  ///< of the instants
  std::uint64_t spent_{};
};

std::string at_time(double t) {
  std::array<char, 32> number{};
  const auto end =
      std::to_chars(number.data(), number.data() + number.size(), t, std::chars_format::general, 6);
  return "At t = " + std::string(number.data(), end.ptr);
}

std::string place_in_words(const ApproachRecord& approach) {
  return at_time(approach.place.instant()) + " the motion comes as near to " +
         (approach.is_kink ? approach.name + " = 0" : "'" + approach.name + "'") + " as its error";
}

/// Around the place, where the other way is to meet what the computation that was there does not, or the
/// other way about.
bool goes_otherwise(const Simulation& other, const Simulation& was_there, const ApproachRecord& approach,
                    double begin) {
  if (approach.is_kink || approach.place.is_condition) return true;
  const double until = approach.place.t + widened * (approach.place.t - begin);
  const auto met = [&](const Simulation& way) {
    const auto is_there = [&](double t) { return begin <= t && t <= until; };
    const bool stops = way.stop && is_there(way.stop->t);
    return std::ranges::count_if(way.sections, is_there, &SectionRecord::t) + (stops ? 1 : 0);
  };
  return met(other) != met(was_there);
}

struct Start {
  double t{};
  std::vector<double> y;
  bool is_struck{};  ///< it begins with the impact
};

/// What the impacts of an event leave.
std::vector<double> struck(const ComputedMotion& motion, const std::string& event, double t,
                           std::vector<double> y) {
  const InstantImpacts impacts(motion.dynamics, motion.request.parameters, time_round_off(t));
  std::vector<InstantImpacts::Happened> all;
  const std::vector<ParsedImpact>& known = motion.dynamics.model().parsed.impacts;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i].event == event) all.push_back({i, y});
  }
  return impacts.repeat(t, std::move(y), all);
}

/// Bodies that nothing presses and nothing parts, after an impact that took all speed from their distance,
/// may meet again anywhere: it takes as much again as the errors leave.
std::optional<Start> start_of(const Fork& fork, const ApproachRecord& approach,
                              const ComputedMotion& motion) {
  const double begin = fork.begin();
  if (auto y = fork.start(begin)) return Start{begin, std::move(*y), false};
  const bool is_impact = !approach.is_kink && !approach.ends_motion && !approach.place.is_condition;
  if (!is_impact || approach.place.met || begin > approach.begun) return std::nullopt;
  const double t = approach.place.t;
  return Start{t, struck(motion, approach.name, t, fork.at_place()), true};
}

/// The condition that ends the motion, as near to its end as is known: near the end of its domain it may have
/// any value.
bool is_where_it_ends(const ComputedMotion& motion, const ApproachRecord& approach,
                      const std::optional<EventError>& stop_error) {
  const std::optional<Stop>& stop = motion.simulation.stop;
  if (!stop) return false;
  const double near = std::max(one_instant * time_round_off(stop->t), stop_error ? stop_error->time : 0);
  if (std::abs(approach.place.t - stop->t) > near) return false;
  return std::ranges::any_of(motion.dynamics.model().scene.valid_while,
                             [&](const ValidityCondition& condition) {
                               return condition.name == approach.name && condition.reason == stop->reason;
                             });
}

/// Once more with the impacts of each instant in the opposite order.
void add_other_order(const ComputedMotion& motion, std::span<const Simulation> others,
                     std::uint64_t& evaluations_left, OtherWays& result) {
  std::optional<double> t = motion.simulation.order_in_doubt;
  for (const Simulation& other : others) {
    if (other.order_in_doubt) t = std::min(t.value_or(infinity), *other.order_in_doubt);
  }
  if (!t) return;
  result.where = result.where_it_happens = several_at_once(*t);
  result.first_place = *t;
  result.stated_before.resize(motion.width());
  try {
    OtherWay way(motion, motion.request.t_start, ImpactOrder::reverse);
    Simulation& other = result.motions.emplace_back(way.from(motion.request.y_start, evaluations_left));
    result.evaluations += way.spent();
    evaluations_left -= std::min(evaluations_left, way.spent());
    if (other.rows < motion.simulation.rows) result.lost_from = std::max(*t, other.t);
  } catch (const Error&) {
    result.lost_from = *t;
  }
}

/// A place in whose neighbourhood its event is proven to happen once.
bool is_single_crossing(const ApproachRecord& approach, std::span<const EventRecord> events,
                        std::span<const std::optional<EventError>> errors) {
  if (approach.place.others || approach.place.is_condition) return false;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const bool is_known = events[i].name == approach.name && errors[i] && errors[i]->is_single;
    if (is_known && std::abs(events[i].t - approach.place.t) <= errors[i]->time) return true;
  }
  return false;
}

}  // namespace

std::string several_at_once(double t) {
  return at_time(t) + " several impacts happen within one instant, and their order is not known";
}

std::string kinks_too_fast(double t) {
  return at_time(t) +
         " kinks follow each other within some thousand last digits of the time, and one may be passed over";
}

std::string several_kinks_at_once(double t) {
  return at_time(t) +
         " the motion passes several kinks within one instant, and forces between them turn it in that time";
}

OtherWays other_ways(const ComputedMotion& motion, std::span<const Simulation> others,
                     const RowComparison& comparison, std::uint64_t evaluations_left) {
  OtherWays result;
  add_other_order(motion, others, evaluations_left, result);
  const Simulation& was_there = computation_that_tells(motion, others);
  const auto lose = [&](double t) { result.lost_from = std::min(result.lost_from, t); };
  for (const ApproachAsTold& approach : comparison.approaches) {
    const Approach& place = approach.approach.place;
    const double t = place.others ? place.others->from : place.instant();
    if (t > result.lost_from || is_where_it_ends(motion, approach.approach, comparison.stop_error)) continue;
    const Fork fork(motion, approach);
    if (!fork.is_open() || (!place.others && fork.is_negligible())) continue;
    if (result.where.empty()) {
      result.where = place_in_words(approach.approach);
      result.first_place = place.instant();
      result.stated_before = approach.stated;
    }
    if (!approach.approach.is_kink && result.where_it_happens.empty())
      result.where_it_happens = place_in_words(approach.approach);
    result.may_not_end = result.may_not_end || approach.approach.ends_motion;
    if (place.others) {
      lose(t);
      continue;
    }
    try {
      const auto start = start_of(fork, approach.approach, motion);
      if (!start || result.motions.size() == most_ways) {
        lose(t);
        continue;
      }
      OtherWay way(motion, start->t);
      Simulation& other = result.motions.emplace_back(way.from(start->y, evaluations_left));
      result.evaluations += way.spent();
      evaluations_left -= std::min(evaluations_left, way.spent());
      if (other.rows < motion.simulation.rows) lose(std::max(t, other.t));
      const bool may_fail = fork.is_bounded() && !start->is_struck;
      if (may_fail && !goes_otherwise(other, was_there, approach.approach, start->t)) lose(t);
    } catch (const Error&) {
      lose(t);
    }
  }
  return result;
}

std::vector<EventDoubt> events_that_may_happen(const ComputedMotion& motion,
                                               std::span<const ApproachAsTold> near_events,
                                               std::span<const std::optional<EventError>> errors) {
  std::vector<EventDoubt> found;
  for (const ApproachAsTold& near : near_events) {
    const std::string& name = near.approach.name;
    if (std::ranges::find(found, name, &EventDoubt::event) != found.end()) continue;
    if (!is_single_crossing(near.approach, motion.simulation.events, errors) && Fork(motion, near).is_open())
      found.push_back({name, place_in_words(near.approach) + ": whether it happens there cannot be told."});
  }
  return found;
}

/// Computations that have gone both ways differ without others, too.
std::string what_they_change(const OtherWays& ways, const RowComparison& without, const RowComparison& with) {
  if (!ways.where_it_happens.empty()) return ways.where_it_happens + accuracy_reasons::may_go_otherwise;
  for (std::size_t k = 0; k < with.max_abs_error.size(); ++k) {
    const double now = with.max_abs_error[k];
    const bool is_lost = with.horizon && now > much_larger * ways.stated_before[k];
    if (is_lost || now > much_larger * without.max_abs_error[k])
      return ways.where + accuracy_reasons::may_go_otherwise;
  }
  return {};
}

}  // namespace qdot
