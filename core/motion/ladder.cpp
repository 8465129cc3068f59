#include "core/motion/ladder.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/integrate/methods.hpp"
#include "core/motion/error_growth.hpp"
#include "core/motion/motion_comparison.hpp"
#include "core/motion/other_ways.hpp"
#include "core/motion/rounded_events.hpp"
#include "core/motion/row_errors.hpp"
#include "core/motion/stiffness.hpp"

namespace qdot {
namespace {

constexpr double loosest = 1e-2;
constexpr double aim = 0.2;  ///< of the wanted error, when the next tolerance is chosen
/// So small a part of the wanted error leaves room for a looser run; so loose that may be, of what is wanted.
constexpr double far_below = 0.02, loosest_of_wanted = 0.1;
constexpr double next_to_digits = 2 * near_round_off;  ///< the check of a tighter run takes double-doubles
constexpr int most_rungs = 8;
constexpr double dear =
    12;  ///< times the work of a loose run and its check: that of a check in double-doubles
constexpr std::uint64_t work_of_all_rungs = 64;  ///< times that of a loose run, at most
constexpr double much_larger = 10;  ///< errors than without ways that the motion may have gone as well
constexpr double stiff = 1e4;  ///< damping times span: Taylor's method would need 1000 steps for stability

constexpr const char* work_spent =
    "The evaluations that a request may take were spent on the way to the error wanted; this is the best "
    "found.";
constexpr const char* out_of_reach =
    "The error wanted is out of reach for this motion in double precision; this is the best found.";
constexpr const char* may_not_stop =
    "By its error, or as its condition is rounded, the motion may stop at another time or go on: that time has no "
    "error.";
constexpr const char* may_go_otherwise =
    ": it may go on otherwise from there, and the errors stated are of both ways.";
constexpr const char* not_bounded =
    "The error was measured, but not every step has a bound of what it may hide between the places that were "
    "looked at.";

std::string contradiction(const std::string& conserved) {
  return "The answer contradicts itself: " + conserved +
         " is conserved, and changes by more than the errors stated of coordinates and velocities can explain. Do "
         "not rely on them.";
}

/// Over more or fewer kinks or impacts, or others.
bool goes_otherwise(const Simulation& one, const Simulation& other) {
  return one.sections.size() != other.sections.size() ||
         !std::ranges::equal(one.pieces, other.pieces, {}, &PieceRecord::sides, &PieceRecord::sides);
}

class Ladder {
 public:
  Ladder(const Dynamics& dynamics, const SimulationRequest& request, const AccuracyGoal& goal)
      : dynamics_(dynamics),
        request_(request),
        goal_(goal),
        grid_(request),
        is_stiff_(damping_times_span(dynamics, request.parameters, request.t_start, request.y_start,
                                     request.t_end - request.t_start) > stiff) {}

  MeasuredSimulation climb() {
    if (goal_.kind == AccuracyGoal::Kind::tolerances) {
      take(request_.tolerances);
      if (goal_.verify && ended_well(result_.simulation.ending)) measure();
      return finished();
    }
    Tolerances next = start();
    std::optional<Tolerances> given_up;
    for (int i = 0; i < most_rungs; ++i) {
      take(next);
      if (!ended_well(result_.simulation.ending)) break;
      may_give_up_ = is_error_wanted() && i + 1 < most_rungs;
      measure();
      if (expected_excess_) {
        given_up = next;
        excess_ = *expected_excess_;
        next = *tighter(next);
        continue;
      }
      if (keep_best() || result_.max_abs_error.empty() || next.rtol <= tightest_tolerance) break;
      const auto wanted = tighter(next);
      if (!wanted) break;
      next = *wanted;
    }
    if (!best_ && given_up) measure_to_the_end(*given_up);
    if (best_) result_ = std::move(*best_);
    return finished();
  }

 private:
  using Kind = AccuracyGoal::Kind;

  /// A tolerance that is likely to do: errors are ten to a thousand times the tolerance. Where it would be so
  /// tight that the check takes double-doubles, a little more than that is tried first.
  [[nodiscard]] Tolerances start() const {
    if (goal_.kind == Kind::work) return with_rtol(loosest);
    const double likely = std::max(goal_.value * 1e-3, std::min(goal_.value * 1e-2, next_to_digits));
    return with_rtol(std::clamp(likely, tightest_tolerance, loosest));
  }

  [[nodiscard]] static Tolerances with_rtol(double rtol) { return {rtol, rtol * 1e-3}; }

  [[nodiscard]] std::uint64_t left() const {
    const std::uint64_t allowed =
        goal_.kind == Kind::work ? goal_.evaluations : request_.limits.max_evaluations;
    return allowed - std::min(allowed, spent_);
  }

  Simulation run(SimulationRequest request) {
    request.limits.max_evaluations = std::min(request.limits.max_evaluations, left());
    Simulation simulation = simulate(dynamics_, request);
    spent_ += simulation.evaluations;
    return simulation;
  }

  void take(const Tolerances& tolerances) {
    SimulationRequest request = request_;
    request.grid = grid_.t;
    request.tolerances = tolerances;
    request.notes_approaches = goal_.verify;
    if (is_stiff_ && request.method == Method::taylor) request.method = Method::bdf;
    result_ = {};
    result_.tolerances = tolerances;
    result_.simulation = run(std::move(request));
    result_.bounded = result_.simulation.bounded;
  }

  [[nodiscard]] ComputedMotion motion() const {
    return {dynamics_, request_, grid_, *event_rows_, result_.simulation, result_.tolerances, is_stiff_};
  }

  /// What was given up is the best there is.
  void measure_to_the_end(const Tolerances& tolerances) {
    may_give_up_ = false;
    take(tolerances);
    if (!ended_well(result_.simulation.ending)) return;
    measure();
    (void)keep_best();
  }

  void measure() {
    contradicts_ = false;
    doubt_ = 0;
    event_rows_.emplace(grid_.t, result_.simulation);
    result_.events_in_doubt = event_lost_in_rounding(motion());
    expected_excess_.reset();
    const bool is_near = motion().is_near_round_off();
    std::optional<Simulation> sharper;
    if (is_near) sharper = sharper_motion();
    const auto tells_all = [&] { return sharper && sharper->rows == result_.simulation.rows; };
    const auto is_enough = [&] { return tells_all() && !result_.simulation.stop; };
    if (is_enough() && !motion().has_events_in_doubt()) {
      result_.verified_by = Method::taylor;
      return state({std::move(*sharper)});
    }
    std::vector<Simulation> others;
    if (!add_check(others, 1)) return;
    if (is_near || !tells_truncation(motion(), others.front())) {
      if (!is_near && is_measured_looser(others)) return;
      if (!is_near) sharper = sharper_motion();
      if (is_enough() && !goes_otherwise(result_.simulation, others.front()))
        return state({std::move(*sharper)});
      const bool can_afford_another = left() >= 2 * others.front().evaluations;
      if (!tells_all()) {
        if (can_afford_another && !add_check(others, -1)) return;
        if (!can_afford_another) doubt_ = near_round_off;  // no work is left to tell how much less it is
      }
      if (sharper) others.push_back(std::move(*sharper));
    }
    state(others);
  }

  /// Where rounding may be as large as the difference, and both are far below what is wanted, the same check
  /// tells the error of a looser run, and no more digits are needed. False, and all as it was, where that run
  /// does not meet what is wanted.
  bool is_measured_looser(const std::vector<Simulation>& checks) {
    const std::optional<Tolerances> looser = looser_than_needed(checks);
    if (!looser) return false;
    MeasuredSimulation tighter = std::move(result_);
    take(*looser);
    if (ended_well(result_.simulation.ending) && can_be_checked_by(checks.front()) &&
        tells_truncation(motion(), checks.front())) {
      state(checks);
      if (excess(result_.max_abs_error) <= 1 && !contradicts_) return true;
    }
    contradicts_ = false;
    result_ = std::move(tighter);
    return false;
  }

  /// None where the error of the run is not far below what is wanted, or would still be rounding, and where
  /// the check has rows at its events: another run has them at other instants.
  [[nodiscard]] std::optional<Tolerances> looser_than_needed(const std::vector<Simulation>& checks) const {
    if (!is_error_wanted() || !request_.events.empty() || !event_rows_->events().empty()) return std::nullopt;
    const std::vector<double> difference = largest_differences(motion(), checks.front());
    const double now = safety_of_differences * excess(difference), rtol = result_.tolerances.rtol;
    if (!(now <= far_below)) return std::nullopt;
    const double looser = std::min({rtol * aim / now, loosest_of_wanted * goal_.value, loosest});
    const std::vector<double> scale = largest_magnitudes(motion(), Rows::wanted);
    for (std::size_t k = 0; k < scale.size(); ++k) {
      const double then = difference[k] * (looser / rtol);
      if (then > 0 && then < near_round_off * scale[k]) return std::nullopt;
    }
    return looser > rtol ? std::optional(with_rtol(looser)) : std::nullopt;
  }

  std::optional<Simulation> sharper_motion() {
    SharperMotion sharper = in_more_digits(motion(), left());
    spent_ += sharper.evaluations;
    return std::move(sharper.simulation);
  }

  /// False where it does not tell the error of the first.
  bool add_check(std::vector<Simulation>& others, double direction) {
    const ComputedMotion now = motion();
    SimulationRequest request = check_of(now, direction);
    std::optional<ErrorGrowth> growth;
    if (can_give_up()) {
      growth.emplace(now, wanted());
      request.goes_on = [this, &growth](std::size_t first, std::span<const double> rows) {
        return growth->add(first, rows) || !is_enough_to_expect(growth->expected());
      };
    }
    Simulation& other = others.emplace_back(run(std::move(request)));
    event_rows_->set_apart(other, request_.y_start.size());
    if (other.ending != Ending::given_up) return can_be_checked_by(other);
    expected_excess_ = growth->expected();
    return false;
  }

  /// Where a tighter run can be expected to do, and rows at impacts do not differ for another reason.
  [[nodiscard]] bool can_give_up() const {
    return may_give_up_ && result_.simulation.method == Method::taylor && !motion().is_near_round_off() &&
           result_.simulation.sections.empty() &&
           left() / work_of_all_rungs >= result_.simulation.evaluations;
  }

  bool can_be_checked_by(const Simulation& other) {
    result_.verified_by = other.method;
    result_.bounded = result_.bounded && other.bounded;
    if (const char* reason = not_comparable(motion(), other)) {
      result_.reason = reason;
      return false;
    }
    if (result_.events_in_doubt.empty()) result_.events_in_doubt = differing_events(motion(), other);
    if (result_.simulation.stop && ended_well(other.ending) && !other.stop) {
      result_.reason =
          "The second computation went on beyond the end of this one: that it stops here is no more "
          "certain than its error allows.";
    }
    return true;
  }

  void state(const std::vector<Simulation>& others) {
    RowComparison comparison = compare(motion(), others, doubt_);
    OtherWays ways = other_ways(motion(), comparison.approaches, left());
    if (!ways.where.empty()) comparison = with_other_ways(comparison, others, std::move(ways));
    result_.max_abs_error = std::move(comparison.max_abs_error);
    result_.event_errors = std::move(comparison.event_errors);
    result_.stop_error = comparison.stop_error;
    result_.horizon = comparison.horizon;
    result_.at_impacts = std::move(comparison.at_impacts);
    if (result_.simulation.stop && !result_.stop_error && result_.reason.empty())
      result_.reason = may_not_stop;
    contradicts_ = !comparison.changed.empty();
    if (contradicts_) result_.reason = contradiction(comparison.changed);
  }

  [[nodiscard]] RowComparison with_other_ways(const RowComparison& without, std::vector<Simulation> others,
                                              OtherWays ways) {
    spent_ += ways.evaluations;
    std::ranges::move(ways.motions, std::back_inserter(others));
    RowComparison all = compare(motion(), others, doubt_, ways.lost_from);
    bool is_larger = false;
    for (std::size_t k = 0; k < all.max_abs_error.size(); ++k)
      is_larger = is_larger || all.max_abs_error[k] > much_larger * without.max_abs_error[k];
    if (is_larger) result_.reason = ways.where + may_go_otherwise;
    return all;
  }

  [[nodiscard]] bool is_error_wanted() const {
    return goal_.kind == Kind::absolute || goal_.kind == Kind::relative;
  }

  /// The error wanted of each column.
  [[nodiscard]] std::vector<double> wanted() const {
    std::vector<double> wanted = largest_magnitudes(motion(), Rows::wanted);
    for (double& error : wanted) error = goal_.value * (goal_.kind == Kind::relative ? error : 1.0);
    return wanted;
  }

  /// The largest error in units of what is wanted; 1 is met.
  [[nodiscard]] double excess(const std::vector<double>& error) const {
    const std::vector<double> wanted = this->wanted();
    double largest = 0;
    for (std::size_t k = 0; k < error.size(); ++k) {
      if (error[k] > 0) largest = std::max(largest, error[k] / wanted[k]);
    }
    return largest;
  }

  /// True when the goal is met.
  bool keep_best() {
    if (result_.max_abs_error.empty()) return false;
    if (goal_.kind == Kind::work) {
      best_ = result_;
      return false;
    }
    const double now = excess(result_.max_abs_error);
    result_.meets_request = result_.bounded && now <= 1 && !contradicts_;
    excess_ = now;
    if (!best_ || best_contradicts_ || (now < best_excess_ && !contradicts_)) {
      best_ = result_;
      best_excess_ = now;
      best_contradicts_ = contradicts_;
    }
    return now <= 1 && !contradicts_;
  }

  /// The next tolerance; none when there is no work left for it.
  [[nodiscard]] std::optional<Tolerances> tighter(const Tolerances& now) const {
    if (goal_.kind != Kind::work) {
      return with_rtol(rtol_to_meet(excess_, now.rtol));
    }
    // A run and its check cost twice as much as now when the tolerance goes down by this factor.
    const double cost = static_cast<double>(best_->simulation.evaluations) * 2.4;
    const double growth = static_cast<double>(left()) / cost;
    if (growth < 1) return std::nullopt;
    const double factor = evaluate(Function::exp, -15 * evaluate(Function::log, growth));
    // Near round-off a check takes double-doubles, and several times the work.
    const double least = growth < dear ? 100 * near_round_off : tightest_tolerance;
    if (now.rtol <= least) return std::nullopt;
    return with_rtol(std::clamp(now.rtol * factor, least, std::max(least, now.rtol * 0.1)));
  }

  /// Of a run with that error, in units of what is wanted.
  [[nodiscard]] static double rtol_to_meet(double excess, double rtol) {
    return std::max(tightest_tolerance, rtol * std::clamp(aim / excess, 1e-6, 0.1));
  }

  /// The next run is not chosen by a guess where its check takes double-doubles, except from next to them.
  [[nodiscard]] bool is_enough_to_expect(double excess) const {
    const double rtol = result_.tolerances.rtol;
    return rtol <= next_to_digits || rtol_to_meet(excess, rtol) >= next_to_digits;
  }

  MeasuredSimulation finished() {
    grid_.thin(result_.simulation, request_.y_start.size(), request_.columns.size());
    result_.evaluations = spent_;
    if (is_error_wanted() && result_.max_abs_error.empty()) {
      result_.meets_request = false;  // for the reason that there is already
    } else if (result_.meets_request == false && result_.reason.empty()) {
      const bool work_is_spent = doubt_ > 0 || (result_.tolerances.rtol > tightest_tolerance &&
                                                left() < result_.simulation.evaluations);
      result_.reason = !result_.bounded ? not_bounded : work_is_spent ? work_spent : out_of_reach;
    }
    return std::move(result_);
  }

  const Dynamics& dynamics_;
  const SimulationRequest& request_;
  const AccuracyGoal& goal_;
  DenseGrid grid_;
  bool is_stiff_;  ///< explicit methods are of no use
  std::optional<EventRows> event_rows_;
  MeasuredSimulation result_;
  std::optional<MeasuredSimulation> best_;
  double best_excess_{}, excess_{};
  bool may_give_up_{false};
  std::optional<double> expected_excess_;              ///< of a motion whose check was given up
  bool contradicts_{false}, best_contradicts_{false};  ///< what is conserved has changed
  double doubt_{};                                     ///< of each column: round-off that was not measured
  std::uint64_t spent_{};
};

}  // namespace

MeasuredSimulation simulate_with_error(const Dynamics& dynamics, const SimulationRequest& request,
                                       const AccuracyGoal& goal) {
  if (record_of(request.method).has_fixed_step() && goal.kind != AccuracyGoal::Kind::tolerances) {
    throw std::invalid_argument("a method of fixed step has no goal");
  }
  return Ladder(dynamics, request, goal).climb();
}

}  // namespace qdot
