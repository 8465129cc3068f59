#include "core/motion/simulation.hpp"

#include <algorithm>

#include "core/dynamics/missing_values.hpp"
#include "core/motion/many_pieces.hpp"
#include "core/motion/met_impacts.hpp"
#include "core/motion/met_kinks.hpp"
#include "core/motion/passed_jumps.hpp"
#include "core/motion/running_motion.hpp"
#include "core/motion/section_run.hpp"
#include "core/motion/simulation_output.hpp"
#include "core/motion/start_conditions.hpp"
#include "core/numerics/root.hpp"

namespace qdot {
namespace {

constexpr double some_roundings = 64;  ///< of time: one instant
constexpr std::size_t most_impacts = 10'000;

class Simulator {
 public:
  Simulator(const Dynamics& dynamics, const SimulationRequest& request)
      : motion_(dynamics, request),
        run_(dynamics, request, motion_.sections, motion_.apart, motion_.sides),
        kinks_(motion_),
        impacts_(motion_) {}

  Simulation run() {
    const SimulationRequest& request = motion_.request;
    refuse_missing_values(motion_.dynamics.model(), request.parameters, request.t_start, request.y_start);
    check_configuration(motion_.sections.watches(), start());
    if (!stopped_at_start()) {
      std::size_t impacts = 0;
      while (segment()) {
        if (++impacts == most_impacts) motion_.result.ending = Ending::step_limit;
        if (impacts == most_impacts || !impacts_.pass()) break;
      }
    }
    kinks_.record_piece({});
    motion_.sections.finish(motion_.result.t);
    kinks_.doubt_last_row(met_at_end_);
    finish();
    return std::move(motion_.result);
  }

 private:
  [[nodiscard]] MotionStart start() const {
    return {motion_.result.t, motion_.result.y, motion_.request.t_end - motion_.request.t_start};
  }

  bool stopped_at_start() {
    const Watch* failing =
        failing_at_start(motion_.sections.watches(), motion_.sections.system(), start(),
                         [&](const Watch& watch) { return motion_.sides.at_start(watch); });
    if (failing == nullptr) return false;
    const std::vector<double>& grid = motion_.request.grid;
    Simulation& result = motion_.result;
    result.stop = Stop{failing->reason, result.t, failing->message};
    result.ending = Ending::event;
    result.states = result.y;
    result.rows = !grid.empty() && grid.front() == result.t ? 1 : 0;
    result.states.resize(result.rows * result.y.size());
    row_sections_.resize(result.rows, motion_.sections.section());
    return true;
  }

  /// Integrates to the next impact. True when there was one.
  bool segment() {
    Simulation& result = motion_.result;
    segments_.push_back({result.rows, result.t, result.y});
    while (motion_.is_determined) {
      const Run done = section();
      if (impacts_.record_events(done)) return true;
      motion_.sides.go_on();
      if (result.stop) return false;
      if (run_.leaves_rest(done)) continue;
      if (done.ending != Ending::event) return false;
      std::vector<bool> met = kinks_.at_end(done);
      kinks_.doubt_hidden(done);
      if (done.t >= motion_.request.t_end) {
        result.ending = Ending::reached_end;
        met_at_end_ = std::move(met);
        return false;
      }
      if (std::ranges::find(met, true) == met.end()) continue;
      kinks_.record_piece(met);
      if (takes_too_many_pieces(result, motion_.request)) {
        result.ending = Ending::step_limit;
        return false;
      }
      kinks_.pass(met);
    }
    result.ending = Ending::undetermined;
    return false;
  }

  Run section() {
    Run done = run_.from(motion_.result);
    add_approaches(done);
    motion_.unseen.add(done);
    motion_.apart.add(done);
    motion_.sides.take(done);
    note_untold(done);
    if (motion_.request.notes_approaches) note_passed_jumps(motion_.sections, done, motion_.result);
    append(done, motion_.result);
    row_sections_.resize(motion_.result.rows, motion_.sections.section());
    return done;
  }

  /// Where the motion stays on a kink, what is zero with it keeps no sign. A time that rounding makes one
  /// instant hides nothing where the sign is the same behind it.
  void note_untold(const Run& done) {
    if (std::ranges::find(motion_.sections.sides(), 0) != motion_.sections.sides().end()) return;
    const std::vector<Watch>& watches = motion_.sections.watches();
    for (std::size_t i = 0; i < watches.size(); ++i) {
      if (!motion_.sections.only_reports(i) || motion_.sections.is_jump(i) || done.untold[i] == 0) continue;
      const bool is_instant = done.untold[i] <= some_roundings * time_round_off(done.t);
      const bool is_same = watches[i].value(done.t, done.y) * done.signs[i] > 0;
      if (!is_instant || !is_same)
        motion_.result.untold.push_back({watches[i].name, done.t - done.untold[i]});
    }
  }

  void add_approaches(Run& done) {
    for (Approach& approach : done.approaches) {
      const std::vector<double>& before = motion_.unseen.so_far();
      approach.unseen.resize(before.empty() ? approach.unseen.size() : before.size());
      for (std::size_t k = 0; k < before.size(); ++k) approach.unseen[k] += before[k];
      const bool is_reported_only = motion_.sections.only_reports(approach.event);
      auto& all = is_reported_only ? motion_.result.near_events : motion_.result.approaches;
      all.push_back(motion_.sections.approach(std::move(approach), motion_.result.t));
    }
  }

  void finish() {
    Simulation& result = motion_.result;
    result.bounded = result.bounded && result.hidden_kinks < SectionRun::most_hidden;
    result.stays = std::move(motion_.sections.stays());
    for (auto* approaches : {&result.approaches, &result.near_events})
      std::ranges::stable_sort(*approaches, {}, [](const auto& a) { return a.place.instant(); });
    result.unseen = motion_.unseen.take_rows();
    result.apart_at_end = motion_.apart.at_end();
    auto [apart, by_rounding] = motion_.apart.take_rows();
    result.apart = std::move(apart);
    result.apart_by_rounding = std::move(by_rounding);
    fill_columns(motion_.request, motion_.sections, row_sections_, result);
    note_what_is_kept(motion_.dynamics, motion_.request, segments_, result);
  }

  RunningMotion motion_;
  SectionRun run_;
  MetKinks kinks_;
  MetImpacts impacts_;
  std::vector<bool> met_at_end_;           ///< kinks
  std::vector<std::size_t> row_sections_;  ///< for each row
  std::vector<Segment> segments_;
};

}  // namespace

Simulation simulate(const Dynamics& dynamics, const SimulationRequest& request) {
  return Simulator(dynamics, request).run();
}

}  // namespace qdot
