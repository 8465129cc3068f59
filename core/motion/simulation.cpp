#include "core/motion/simulation.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/work.hpp"
#include "core/dynamics/watch.hpp"
#include "core/integrate/events.hpp"
#include "core/integrate/integrate.hpp"
#include "core/motion/accumulation.hpp"
#include "core/motion/apart_along.hpp"
#include "core/motion/instant_impacts.hpp"
#include "core/motion/motion_sections.hpp"
#include "core/motion/start_conditions.hpp"
#include "core/motion/start_from_rest.hpp"
#include "core/motion/unseen_along.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_impacts = 10'000;
constexpr std::size_t rows_of_reference = 64;  ///< at which it is looked at what that keeps
constexpr double short_flight = 1e-2;          ///< of the longest
constexpr const char* accumulation =
    "The impacts follow each other faster and faster, and accumulate at this time.";

class Simulator {
 public:
  Simulator(const Dynamics& dynamics, const SimulationRequest& request)
      : dynamics_(dynamics),
        request_(request),
        sections_(dynamics, request),
        from_rest_(dynamics, request),
        apart_(request) {
    result_.t = request.t_start;
    result_.y = request.y_start;
    result_.method = request.method;
    is_determined_ = sections_.begin(result_.t, result_.y);
    result_.symplectic = sections_.system().canonical.has_value();
  }

  Simulation run() {
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
    result_.stays = std::move(sections_.stays());
    result_.unseen = unseen_.take_rows();
    auto [apart, by_rounding] = apart_.take_rows();
    result_.apart = std::move(apart);
    result_.apart_by_rounding = std::move(by_rounding);
    fill_columns();
    note_what_is_kept();
    return std::move(result_);
  }

 private:
  [[nodiscard]] MotionStart start() const {
    return {result_.t, result_.y, request_.t_end - request_.t_start};
  }

  bool stopped_at_start() {
    const Watch* failing = failing_at_start(sections_.watches(), sections_.system(), start());
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
      if (result_.stop) return false;
      if (leaves_rest(done)) continue;
      if (done.ending != Ending::event) return false;
      if (done.t >= request_.t_end) {
        result_.ending = Ending::reached_end;
        return false;
      }
      const std::vector<bool> met = kinks_met(done);
      record_piece(met);
      pass_kinks(met);
    }
    result_.ending = Ending::undetermined;
    return false;
  }

  void pass_kinks(const std::vector<bool>& met) {
    const auto first = static_cast<std::size_t>(std::ranges::find(met, true) - met.begin());
    if (!apart_.is_wanted() || first == met.size()) {
      is_determined_ = sections_.pass(result_.t, result_.y, met);
      return;
    }
    SectionEnd end = now_ending(sections_.ends()[first].value);
    is_determined_ = sections_.pass(result_.t, result_.y, met);
    if (!is_determined_) return;
    finish(end);
    end.doubt = sections_.doubt_of_instant();
    apart_.pass(std::move(end));
  }

  [[nodiscard]] SectionEnd now_ending(decltype(EventFunction::value) g) const {
    return {.t = result_.t,
            .before = result_.y,
            .slopes_before = slopes(result_.y),
            .after = {},
            .slopes_after = {},
            .g = std::move(g)};
  }

  /// The section after it has begun.
  void finish(SectionEnd& end) const {
    end.after = result_.y;
    end.slopes_after = slopes(result_.y);
  }

  /// Whether the motion goes on by a step away from a place where a speed is zero, or after one.
  [[nodiscard]] bool leaves_rest(const Run& done) const {
    if (done.ending == Ending::event || done.ending == Ending::given_up) return false;
    if (done.ending == Ending::reached_end) return done.t < request_.t_end;
    return done.steps > 0 && from_rest_.length(done.t, done.y, sections_.system()).has_value();
  }

  void record_piece(const std::vector<bool>& met) {
    if (sections_.kinks() == 0) return;
    PieceRecord& piece = result_.pieces.emplace_back(
        PieceRecord{result_.t, result_.t - sections_.begun(), sections_.sides(), {}});
    for (std::size_t k = 0; k < met.size(); ++k) {
      if (met[k]) piece.ended_by.push_back(k);
    }
  }

  /// Integrates to the next kink or impact, or by one short step away from rest.
  Run section() {
    RunRequest run;
    run.t_start = result_.t;
    run.y_start = result_.y;
    run.t_end = request_.t_end;
    run.grid = std::span(request_.grid).subspan(result_.rows);
    if (request_.goes_on) {
      run.goes_on = [this, before = result_.rows](std::size_t first, std::span<const double> rows) {
        return request_.goes_on(before + first, rows);
      };
    }
    run.method = request_.method;
    const std::optional<double> step = from_rest_.length(run.t_start, run.y_start, sections_.system());
    if (step) {
      run.method = Method::erk;
      run.t_end = std::min(run.t_end, run.t_start + *step);
      run.grid = run.grid.first(
          static_cast<std::size_t>(std::ranges::upper_bound(run.grid, run.t_end) - run.grid.begin()));
    }
    run.taylor_order = request_.taylor_order;
    run.is_reference = request_.is_reference;
    apart_.ask(run, sections_.originals());
    run.tolerances = request_.tolerances;
    run.h = request_.h;
    run.limits = request_.limits;
    run.limits.max_steps -= std::min(run.limits.max_steps, result_.steps);
    run.limits.max_evaluations -= std::min(run.limits.max_evaluations, result_.evaluations);
    for (const Watch& watch : sections_.watches()) {
      run.events.push_back(watch.event());
      if (run.t_start > request_.t_start) continue;  // the state is off by more than that
      run.events.back().rounding_at_start = [&] {
        return watch.rounding(request_.t_start, request_.y_start);
      };
    }
    mark_impacts_of_now(run.events);
    for (EventFunction& end : sections_.ends()) run.events.push_back(std::move(end));
    Run done = integrate(sections_.system(), run);
    if (step) enclose(run, done);
    result_.bounded = result_.bounded && done.bounded;
    unseen_.add(done);
    result_.accelerations.insert(result_.accelerations.end(), done.accelerations.begin(),
                                 done.accelerations.end());
    apart_.add(done);
    result_.rows += done.rows;
    if (result_.states.empty()) {
      result_.states = std::move(done.states);
    } else {
      result_.states.insert(result_.states.end(), done.states.begin(), done.states.end());
    }
    row_sections_.resize(result_.rows, sections_.section());
    result_.steps += done.steps;
    result_.evaluations += done.evaluations;
    result_.ending = done.ending;
    result_.t = done.t;
    result_.y = done.y;
    return done;
  }

  /// An impact that has just happened, and left its distance as it was, begins at distance zero.
  void mark_impacts_of_now(std::vector<EventFunction>& events) const {
    if (result_.sections.empty() || result_.sections.back().t != result_.t) return;
    const SectionRecord& last = result_.sections.back();
    const std::size_t first = sections_.watches().size() - dynamics_.model().parsed.impacts.size();
    for (const std::size_t impact : last.impacts) {
      EventFunction& event = events[first + impact];
      event.is_zero_at_start = event.direction != Crossing::either &&
                               event.value(last.t, last.before) == event.value(last.t, last.after);
    }
  }

  [[nodiscard]] std::vector<bool> kinks_met(const Run& done) const {
    std::vector<bool> met(sections_.kinks());
    const std::size_t first = sections_.watches().size();
    for (const EventOccurrence& occurrence : done.events) {
      if (occurrence.event >= first && occurrence.t == done.t) met[occurrence.event - first] = true;
    }
    return met;
  }

  /// A step away from rest is not Taylor's; what it may be off by is known otherwise.
  void enclose(const RunRequest& run, Run& done) const {
    const auto off = from_rest_.bound(run.t_start, run.y_start, done.t - run.t_start);
    done.bounded = off.has_value();
    if (!off) return;
    done.unseen_at_end = *off;
    done.unseen.resize(done.states.size());
    for (std::size_t i = 0; i < done.unseen.size(); ++i) done.unseen[i] = (*off)[i % off->size()];
  }

  bool record_events(const Run& done) {
    bool impact = false;
    const std::size_t impacts = dynamics_.model().parsed.impacts.size();
    met_impacts_.assign(impacts, false);
    for (const EventOccurrence& occurrence : done.events) {
      if (occurrence.event >= sections_.watches().size()) continue;  // a kink
      const Watch& watch = sections_.watches()[occurrence.event];
      const bool last = done.ending == Ending::event && occurrence.t == done.t;
      if (watch.kind == Watch::Kind::event || watch.kind == Watch::Kind::impact) {
        record_event({watch.name, occurrence.t, occurrence.y});
        if (watch.kind != Watch::Kind::impact) continue;
        impact = true;
        met_impacts_[occurrence.event + impacts - sections_.watches().size()] = true;
      } else if (last && !result_.stop) {
        result_.stop = Stop{watch.reason, occurrence.t, watch.message};
      }
    }
    return impact && !result_.stop;
  }

  void record_event(EventRecord event) {
    result_.events.push_back(std::move(event));
    if (result_.events.size() > most_occurrences)
      throw Error(ErrorCode::too_large, "the motion meets more events than one answer may hold");
  }

  [[nodiscard]] std::span<const Watch> watches_of_impacts() const {
    return std::span(sections_.watches()).last(dynamics_.model().parsed.impacts.size());
  }

  /// All impacts of this instant. Those that others have started are told as events here.
  [[nodiscard]] InstantImpacts::Passed pass_impacts() {
    const std::vector<ParsedImpact>& impacts = dynamics_.model().parsed.impacts;
    if (!impacts_) impacts_.emplace(dynamics_, request_.parameters, sections_.resolution());
    InstantImpacts::Passed passed = impacts_->pass(result_.t, result_.y, met_impacts_, watches_of_impacts());
    for (const auto& [impact, before] : passed.all) {
      if (met_impacts_[impact]) {
        met_impacts_[impact] = false;  // told already
      } else {
        record_event({impacts[impact].event, result_.t, before});
      }
    }
    return passed;
  }

  /// Goes on from the state after the impact; false when the motion is over there anyway.
  bool apply_impact() {
    InstantImpacts::Passed passed = pass_impacts();
    const double begin = result_.sections.empty() ? request_.t_start : result_.sections.back().t;
    result_.sections.push_back({result_.t, result_.t - begin, result_.y, passed.after, {}});
    for (const auto& [impact, before] : passed.all) result_.sections.back().impacts.push_back(impact);
    if (result_.t >= request_.t_end || result_.sections.size() == request_.end_after_impacts) {
      result_.ending = Ending::reached_end;
      return false;
    }
    if (result_.sections[longest_].duration < result_.sections.back().duration)
      longest_ = result_.sections.size() - 1;
    const double lowest = lowest_flight(passed.all.front().impact);
    if (const auto rest = passed.is_over
                              ? rest_of_impacts(result_.sections, request_.t_end - request_.t_start, lowest)
                              : RestOfImpacts{0, doubt_of_lost(result_.sections, lowest)}) {
      result_.t += rest->time;
      result_.stop = Stop{impacts_accumulate, result_.t, accumulation, rest->doubt};
      return false;
    }
    if (!keeps_constraints(dynamics_, request_, result_.t, result_.y, passed.after))
      throw Error(ErrorCode::invalid_state,
                  "The state after an impact, as its map says, does not obey the constraints.");
    const std::size_t first = passed.all.front().impact;
    SectionEnd end = now_ending(watches_of_impacts()[first].value);
    end.map = [this, t = end.t, all = passed.all](const std::vector<double>& y) {
      return impacts_->repeat(t, y, all);
    };
    result_.y = passed.after;
    is_determined_ = sections_.begin(result_.t, result_.y);
    if (!is_determined_) return true;
    finish(end);
    unseen_.doubt_instant(end);
    apart_.pass(std::move(end));
    return true;
  }

  /// How short a flight may be before the distance is rounded as much as it is high.
  [[nodiscard]] double lowest_flight(std::size_t impact) const {
    const SectionRecord& longest = result_.sections[longest_];
    if (result_.sections.back().duration > short_flight * longest.duration) return 0;
    return qdot::lowest_flight(watches_of_impacts()[impact], longest, slopes(longest.before),
                               result_.sections.back());
  }

  [[nodiscard]] std::vector<double> slopes(const std::vector<double>& y) const {
    std::vector<double> result(y.size());
    if (sections_.system().derivative(result_.t, y, result) != Evaluation::ok) std::ranges::fill(result, 0);
    return result;
  }

  [[nodiscard]] std::span<const double> row(std::size_t i) const {
    return std::span(result_.states).subspan(i * request_.y_start.size(), request_.y_start.size());
  }

  /// How well a reference keeps it some rows tell, of which the last is one.
  void note_what_is_kept() {
    const std::size_t every = request_.is_reference ? 1 + result_.rows / rows_of_reference : 1;
    std::vector<double> changes = conserved_changes(dynamics_, request_, result_.states, segments_, every);
    result_.conserved = conserved_records(dynamics_, request_, changes);
    if (request_.is_reference) return;
    result_.changes = std::move(changes);
    result_.constraints = constraints_along(dynamics_, request_, result_.states);
  }

  void fill_columns() {
    if (request_.columns.empty()) return;
    const std::size_t width = request_.columns.size();
    result_.columns.resize(result_.rows * width);
    for (std::size_t i = 0; i < result_.rows; ++i) {
      if (i % 256 == 0) check_interruption();
      const std::span<double> out = std::span(result_.columns).subspan(i * width, width);
      auto& [function, workspace] = sections_.columns_in(row_sections_[i]);
      if (function->evaluate(request_.grid[i], row(i), workspace, out) == Evaluation::ok) continue;
      throw Error(ErrorCode::invalid_state, "One of the columns has no finite value along this motion.");
    }
  }

  const Dynamics& dynamics_;
  const SimulationRequest& request_;
  MotionSections sections_;
  StartFromRest from_rest_;
  ApartAlong apart_;
  std::optional<InstantImpacts> impacts_;
  std::vector<bool> met_impacts_;  ///< at the end of the section
  std::size_t longest_{};          ///< of the sections between impacts
  bool is_determined_{true};
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
