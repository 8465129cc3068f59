#include "core/motion/simulation.hpp"

#include <algorithm>

#include "core/dynamics/missing_values.hpp"
#include "core/dynamics/watch.hpp"
#include "core/integrate/events.hpp"
#include "core/motion/apart_along.hpp"
#include "core/motion/conditions_after_impact.hpp"
#include "core/motion/impacts_along.hpp"
#include "core/motion/many_pieces.hpp"
#include "core/motion/motion_sections.hpp"
#include "core/motion/section_run.hpp"
#include "core/motion/simulation_output.hpp"
#include "core/motion/start_conditions.hpp"
#include "core/motion/unseen_along.hpp"
#include "core/numerics/root.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_impacts = 10'000;
constexpr const char* accumulation =
    "The impacts follow each other faster and faster, and accumulate at this time.";

constexpr const char* contact =
    "After this impact the bodies stay in contact, pressed together. The scene says nothing of motions in contact, so "
    "this one ends here.";

class Simulator {
 public:
  Simulator(const Dynamics& dynamics, const SimulationRequest& request)
      : dynamics_(dynamics),
        request_(request),
        sections_(dynamics, request),
        apart_(request),
        sides_(dynamics, request, sections_),
        run_(dynamics, request, sections_, apart_, sides_),
        impacts_(dynamics, request, sections_) {
    result_.t = request.t_start;
    result_.y = request.y_start;
    result_.method = request.method;
    is_determined_ = sections_.begin(result_.t, result_.y);
    doubt_begin();
    result_.symplectic = sections_.system().canonical.has_value();
  }

  Simulation run() {
    refuse_missing_values(dynamics_.model(), request_.parameters, request_.t_start, request_.y_start);
    check_configuration(sections_.watches(), start());
    if (!stopped_at_start()) {
      std::size_t impacts = 0;
      while (segment()) {
        if (++impacts == most_impacts) result_.ending = Ending::step_limit;
        if (impacts == most_impacts || !apply_impact()) break;
      }
    }
    record_piece({});
    sections_.finish(result_.t);
    doubt_last_row();
    result_.bounded = result_.bounded && result_.hidden_kinks < SectionRun::most_hidden;
    result_.stays = std::move(sections_.stays());
    for (auto* approaches : {&result_.approaches, &result_.near_events})
      std::ranges::stable_sort(*approaches, {}, [](const auto& a) { return a.place.instant(); });
    result_.unseen = unseen_.take_rows();
    result_.apart_at_end = apart_.at_end();
    auto [apart, by_rounding] = apart_.take_rows();
    result_.apart = std::move(apart);
    result_.apart_by_rounding = std::move(by_rounding);
    fill_columns(request_, sections_, row_sections_, result_);
    note_what_is_kept(dynamics_, request_, segments_, result_);
    return std::move(result_);
  }

 private:
  [[nodiscard]] MotionStart start() const {
    return {result_.t, result_.y, request_.t_end - request_.t_start};
  }

  void doubt_begin() {
    apart_.doubt(sections_.doubt_of_begin());
    result_.kinks_in_doubt = result_.kinks_in_doubt || !sections_.doubt_of_begin().empty();
  }

  bool stopped_at_start() {
    const Watch* failing = failing_at_start(sections_.watches(), sections_.system(), start(),
                                            [&](const Watch& watch) { return sides_.at_start(watch); });
    if (failing == nullptr) return false;
    result_.stop = Stop{failing->reason, result_.t, failing->message};
    result_.ending = Ending::event;
    result_.states = result_.y;
    result_.rows = !request_.grid.empty() && request_.grid.front() == result_.t ? 1 : 0;
    result_.states.resize(result_.rows * result_.y.size());
    row_sections_.resize(result_.rows, sections_.section());
    return true;
  }

  /// Integrates to the next impact. True when there was one.
  bool segment() {
    segments_.push_back({result_.rows, result_.t, result_.y});
    while (is_determined_) {
      const Run done = section();
      if (record_events(done)) return true;
      sides_.go_on();
      if (result_.stop) return false;
      if (run_.leaves_rest(done)) continue;
      if (done.ending != Ending::event) return false;
      std::vector<bool> met = kinks_met(done);
      doubt_hidden_kinks(done);
      if (done.t >= request_.t_end) {
        result_.ending = Ending::reached_end;
        met_at_end_ = std::move(met);
        return false;
      }
      if (std::ranges::find(met, true) == met.end()) continue;
      record_piece(met);
      if (takes_too_many_pieces(result_, request_)) {
        result_.ending = Ending::step_limit;
        return false;
      }
      pass_kinks(met);
    }
    result_.ending = Ending::undetermined;
    return false;
  }

  void pass_kinks(const std::vector<bool>& met) {
    const auto first = static_cast<std::size_t>(std::ranges::find(met, true) - met.begin());
    if (!apart_.is_wanted() || first == met.size()) {
      is_determined_ = sections_.pass(result_.t, result_.y, met);
      note_unclear_kinks();
      return;
    }
    SectionEnd end = now_ending(sections_.ends()[first].value);
    is_determined_ = sections_.pass(result_.t, result_.y, met);
    note_unclear_kinks();
    if (!is_determined_) return;
    finish(end);
    doubt_side(end);
    apart_.pass(std::move(end));
  }

  /// Kinks that may have been passed, to and fro, in a time that ends there.
  void doubt_hidden_kinks(const Run& done) {
    const std::size_t first = sections_.watches().size();
    for (const EventOccurrence& occurrence : done.events) {
      if (occurrence.event < first || occurrence.hidden == 0) continue;
      const std::vector<double> off =
          sections_.doubt_behind(occurrence.event - first, occurrence.hidden, result_.t, result_.y);
      apart_.doubt(off);
      result_.kinks_in_doubt = result_.kinks_in_doubt || !off.empty();
      ++result_.hidden_kinks;
    }
  }

  void note_unclear_kinks() {
    result_.kinks_in_doubt = result_.kinks_in_doubt || sections_.is_instant_hidden();
    if (!sections_.is_unclear() || result_.unclear_from) return;
    result_.unclear_from = result_.t;
    result_.is_unclear_by_kinks = true;
  }

  /// A kink that is met where the motion ends is not passed, but may be.
  void doubt_last_row() {
    const auto first = static_cast<std::size_t>(std::ranges::find(met_at_end_, true) - met_at_end_.begin());
    if (!apart_.is_wanted() || first == met_at_end_.size()) return;
    SectionEnd end = now_ending(sections_.ends()[first].value);
    end.after = result_.y;
    if (!sections_.pass(result_.t, end.after, met_at_end_)) return;
    end.slopes_after = sections_.slopes(result_.t, end.after);
    doubt_side(end);
  }

  void doubt_side(SectionEnd& end) {
    end.doubt = sections_.doubt_of_instant();
    end.moved = sections_.moved_instant();
    unseen_.doubt_side(end, apart_.seconds(end, unseen_.so_far()), request_.grid);
  }

  [[nodiscard]] SectionEnd now_ending(decltype(EventFunction::value) g) const {
    return {.t = result_.t,
            .before = result_.y,
            .slopes_before = sections_.slopes(result_.t, result_.y),
            .after = {},
            .slopes_after = {},
            .g = std::move(g)};
  }

  /// The section after it has begun.
  void finish(SectionEnd& end) const {
    end.after = result_.y;
    end.slopes_after = sections_.slopes(result_.t, result_.y);
  }

  void record_piece(const std::vector<bool>& met) {
    if (sections_.kinks() == 0) return;
    PieceRecord& piece = result_.pieces.emplace_back(
        PieceRecord{result_.t, result_.t - sections_.begun(), sections_.sides(), {}});
    for (std::size_t k = 0; k < met.size(); ++k) {
      if (met[k]) piece.ended_by.push_back(k);
    }
  }

  Run section() {
    Run done = run_.from(result_);
    add_approaches(done);
    unseen_.add(done);
    apart_.add(done);
    sides_.take(done);
    append(done, result_);
    row_sections_.resize(result_.rows, sections_.section());
    return done;
  }

  void add_approaches(Run& done) {
    for (Approach& approach : done.approaches) {
      const std::vector<double>& before = unseen_.so_far();
      approach.unseen.resize(before.empty() ? approach.unseen.size() : before.size());
      for (std::size_t k = 0; k < before.size(); ++k) approach.unseen[k] += before[k];
      const bool is_reported_only = sections_.only_reports(approach.event);
      auto& all = is_reported_only ? result_.near_events : result_.approaches;
      all.push_back(sections_.approach(std::move(approach), result_.t));
    }
  }

  [[nodiscard]] std::vector<bool> kinks_met(const Run& done) const {
    std::vector<bool> met(sections_.kinks());
    const std::size_t first = sections_.watches().size();
    for (const EventOccurrence& occurrence : done.events) {
      if (occurrence.event >= first && occurrence.t == done.t && occurrence.hidden == 0)
        met[occurrence.event - first] = true;
    }
    return met;
  }

  bool record_events(const Run& done) {
    bool impact = false;
    ended_by_ = nullptr;
    impacts_.begin_instant();
    for (const EventOccurrence& occurrence : done.events) {
      if (occurrence.event >= sections_.watches().size()) continue;  // a kink
      const Watch& watch = sections_.watches()[occurrence.event];
      const bool last = done.ending == Ending::event && occurrence.t == done.t;
      if (watch.kind == Watch::Kind::event || watch.kind == Watch::Kind::impact) {
        record_event({watch.name, occurrence.t, occurrence.y});
        if (watch.kind != Watch::Kind::impact) continue;
        impact = true;
        impacts_.meet(occurrence.event);
      } else if (last && ended_by_ == nullptr) {
        ended_by_ = &watch;
      }
    }
    if (ended_by_ != nullptr && !impact) stop_by(*ended_by_);
    return impact && !result_.stop;
  }

  void stop_by(const Watch& watch) {
    result_.stop = Stop{watch.reason, result_.t, watch.message};
    meet_condition(watch.name, result_.t, result_.approaches);
  }

  /// What an impact of the same instant turns the motion away from may lie behind it, and does where both are
  /// one surface.
  bool ends_in_instant(const SectionRecord& impact) {
    if (ended_by_ == nullptr) return false;
    const Watch& met = impacts_.watches()[impact.impacts.front()];
    const bool is_left_alone =
        ended_by_->value(impact.t, impact.before) == ended_by_->value(impact.t, impact.after);
    const bool turns =
        is_left_alone && !sides_.goes_through(*ended_by_, impact.t, impact.before, impact.after);
    if (!turns || ended_by_->kind != Watch::Kind::validity) {
      stop_by(*ended_by_);
    } else if (!sides_.are_same_surface(*ended_by_, met, impact.t, impact.before) && !result_.unclear_from) {
      result_.unclear_from = impact.t;
    }
    return result_.stop.has_value();
  }

  void record_event(EventRecord event) {
    result_.events.push_back(std::move(event));
    if (result_.events.size() > most_occurrences)
      throw Error(ErrorCode::too_large, "the motion meets more events than one answer may hold");
  }

  /// All impacts of this instant. Those that others have started are told as events here.
  [[nodiscard]] InstantImpacts::Passed pass_impacts() {
    InstantImpacts::Passed passed = impacts_.pass(result_.t, result_.y, sides_);
    std::vector<bool> told(impacts_.watches().size());
    for (const auto& [impact, before] : passed.all) {
      if (told[impact] || !impacts_.has_met(impact))
        record_event({dynamics_.model().parsed.impacts[impact].event, result_.t, before});
      told[impact] = true;
    }
    if (passed.order_matters) doubt_order();
    if (passed.is_unclear && !result_.unclear_from) result_.unclear_from = result_.t;
    return passed;
  }

  void doubt_order() {
    if (!result_.order_in_doubt) result_.order_in_doubt = result_.t;
    for (auto event = result_.events.rbegin(); event != result_.events.rend() && event->t == result_.t;
         ++event)
      event->is_in_doubt = true;
  }

  /// Events of this instant, from which the impact has turned the motion away: they may be behind it.
  void doubt_events_beside(const SectionRecord& impact) {
    for (auto event = result_.events.rbegin(); event != result_.events.rend() && event->t == impact.t;
         ++event) {
      const auto watch = std::ranges::find(sections_.watches(), event->name, &Watch::name);
      if (watch == sections_.watches().end() || watch->kind != Watch::Kind::event) continue;
      const Watch& met = impacts_.watches()[impact.impacts.front()];
      const bool is_certain = sides_.goes_through(*watch, impact.t, impact.before, impact.after) ||
                              sides_.are_same_surface(*watch, met, impact.t, impact.before);
      if (!is_certain) event->is_in_doubt = true;
    }
  }

  /// Goes on from the state after the impact; false when the motion is over there anyway.
  bool apply_impact() {
    InstantImpacts::Passed passed = pass_impacts();
    const double begin = result_.sections.empty() ? request_.t_start : result_.sections.back().t;
    result_.sections.push_back({result_.t, result_.t - begin, result_.y, passed.after, {}});
    for (const auto& [impact, before] : passed.all) result_.sections.back().impacts.push_back(impact);
    sides_.pass(result_.sections.back());
    doubt_events_beside(result_.sections.back());
    if (ends_in_instant(result_.sections.back())) {
      result_.ending = Ending::event;
      return false;
    }
    if (result_.t >= request_.t_end || result_.sections.size() == request_.end_after_impacts) {
      result_.ending = Ending::reached_end;
      return false;
    }
    if (const auto rest = impacts_.rest(result_.sections, passed)) {
      result_.t += rest->time;
      result_.stop =
          Stop{impacts_accumulate, result_.t, rest->in_contact ? contact : accumulation, rest->doubt};
      return false;
    }
    if (!keeps_constraints(dynamics_, request_, result_.t, result_.y, passed.after))
      throw Error(ErrorCode::invalid_state,
                  "The state after an impact, as its map says, does not obey the constraints.");
    const std::size_t first = passed.all.front().impact;
    const double late = sides_.late_at_begin(impacts_.watches()[first], result_.sections.back());
    SectionEnd end = now_ending(impacts_.watches()[first].value);
    end.rounding = impacts_.watches()[first].own_rounding(result_.t, result_.y);
    end.map = [this, all = passed.all](double t, const std::vector<double>& y) {
      return impacts_.repeat(t, y, all);
    };
    result_.y = passed.after;
    is_determined_ = sections_.begin(result_.t, result_.y);
    if (!is_determined_) return true;
    finish(end);
    doubt_instant(end, passed, std::max({time_round_off(end.t), passed.within, late}));
    apart_.pass(std::move(end));
    apart_.doubt(passed.rounding);
    doubt_begin();
    if (request_.notes_approaches) note_conditions(sections_, apart_.at_end(), unseen_.so_far(), result_);
    return true;
  }

  /// The motion may go on for so long as each of several impacts has left it.
  void doubt_instant(const SectionEnd& end, const InstantImpacts::Passed& passed, double late) {
    unseen_.doubt_instant(end, late);
    SectionEnd between = end;
    between.map = nullptr;
    for (std::size_t i = 1; i < passed.all.size(); ++i) {
      between.after = passed.all[i].before;
      unseen_.doubt_instant(between, late);
    }
  }

  const Dynamics& dynamics_;
  const SimulationRequest& request_;
  MotionSections sections_;
  ApartAlong apart_;
  EventSides sides_;
  SectionRun run_;
  ImpactsAlong impacts_;
  bool is_determined_{true};
  const Watch* ended_by_{};                ///< in this instant
  std::vector<bool> met_at_end_;           ///< kinks
  std::vector<std::size_t> row_sections_;  ///< for each row
  std::vector<Segment> segments_;
  UnseenAlong unseen_;
  Simulation result_;
};

}  // namespace

Simulation simulate(const Dynamics& dynamics, const SimulationRequest& request) {
  return Simulator(dynamics, request).run();
}

}  // namespace qdot
