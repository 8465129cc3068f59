#include "core/motion/measurement.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/integrate/methods.hpp"
#include "core/motion/accumulation.hpp"
#include "core/motion/accuracy_reasons.hpp"
#include "core/motion/conditions_at_stop.hpp"
#include "core/motion/error_growth.hpp"
#include "core/motion/hidden_impacts.hpp"
#include "core/motion/resolved_size.hpp"
#include "core/motion/rounded_events.hpp"
#include "core/motion/rounded_forces.hpp"
#include "core/motion/row_errors.hpp"
#include "core/motion/stiffness.hpp"
#include "core/motion/useful_part.hpp"

namespace qdot {
namespace {

constexpr std::uint64_t work_of_all_rungs = 64;  ///< times that of a loose run, at most
constexpr double unmeasurable = 1e-200;  ///< is no error of a column that is 0 all along: room for underflow
/// Times what is left from where impacts fork to where they accumulate: each way has forks of its own.
constexpr double of_other_cascades = 4;
/// Evaluations of a loose run from zeros: where it takes more, they may be those of another motion, as steps
/// may leave the place where cos(x/a) is that of a tiny a.
constexpr std::uint64_t enough_from_rest = 50'000;
constexpr double without_bound = 1e299;  ///< are errors that follow from what has none
constexpr double stiff = 1e4;  ///< damping times span: Taylor's method would need 1000 steps for stability

/// Over more or fewer kinks or impacts, or others.
bool goes_otherwise(const Simulation& one, const Simulation& other) {
  return one.sections.size() != other.sections.size() ||
         !std::ranges::equal(one.pieces, other.pieces, {}, &PieceRecord::sides, &PieceRecord::sides);
}

/// A sentence where one of the computations comes to where it may go on in several ways; else empty.
std::string why_unclear(const Simulation& motion, const std::vector<Simulation>& others) {
  const Simulation* first = nullptr;
  const auto look = [&](const Simulation& one) {
    if (one.unclear_from && (first == nullptr || *one.unclear_from < *first->unclear_from)) first = &one;
  };
  look(motion);
  std::ranges::for_each(others, look);
  if (first == nullptr) return {};
  const double t = *first->unclear_from;
  const std::string what = first->has_fast_kinks        ? kinks_too_fast(t)
                           : first->is_unclear_by_kinks ? several_kinks_at_once(t)
                                                        : several_at_once(t);
  return what + accuracy_reasons::may_go_anywhere;
}

}  // namespace

Measurement::Measurement(const Dynamics& dynamics, const SimulationRequest& request, const AccuracyGoal& goal)
    : dynamics_(dynamics),
      request_(request),
      goal_(goal),
      grid_(request),
      is_stiff_(damping_times_span(dynamics, request.parameters, request.t_start, request.y_start,
                                   request.t_end - request.t_start) > stiff),
      size_(resolved_size(request.y_start)),
      size_from_rest_(small_size_from_rest(dynamics, request)) {}

double Measurement::resolve_columns() {
  if (goal_.kind != AccuracyGoal::Kind::relative) return 1;
  const std::vector<double>& error = result_.max_abs_error;
  const std::vector<double> wanted = wanted_for(error), size = largest_magnitudes(motion(), Rows::wanted);
  const auto [rtol, atol] = result_.tolerances;
  double times = 1;
  for (std::size_t k = 0; k < error.size(); ++k) {
    const double resolved = std::max(size[k], least_size);
    if (size[k] == 0 || !(error[k] > wanted[k]) || atol <= rtol * resolved) continue;
    size_ = std::min(size_, resolved);
    times = std::max(times, atol / (rtol * resolved));
  }
  return times;
}

std::uint64_t Measurement::left() const {
  const std::uint64_t allowed =
      goal_.kind == AccuracyGoal::Kind::work ? goal_.evaluations : request_.limits.max_evaluations;
  return allowed - std::min(allowed, spent_);
}

void Measurement::take(Tolerances tolerances) {
  SimulationRequest request = request_;
  request.grid = grid_.t;
  if (goal_.kind != AccuracyGoal::Kind::tolerances)
    tolerances.atol = std::min(tolerances.atol, tolerances.rtol * size_);
  request.tolerances = tolerances;
  request.notes_approaches = goal_.verify;
  if (is_stiff_ && request.method == Method::taylor) request.method = Method::bdf;
  const bool may_be_too_loose = goal_.kind != AccuracyGoal::Kind::tolerances && size_from_rest_ < size_;
  if (may_be_too_loose)
    request.limits.max_evaluations = std::min(request.limits.max_evaluations, enough_from_rest);
  result_ = {};
  result_.tolerances = tolerances;
  result_.simulation = run(std::move(request));
  if (may_be_too_loose && !ended_well(result_.simulation.ending) && left() > 0) {
    size_ = size_from_rest_;
    return take({tolerances.rtol, std::min(tolerances.atol, tolerances.rtol * size_)});
  }
  result_.bounded = result_.simulation.bounded;
}

Simulation Measurement::run(SimulationRequest request) {
  request.limits.max_evaluations = std::min(request.limits.max_evaluations, left());
  Simulation simulation = simulate(dynamics_, request);
  spent_ += simulation.evaluations;
  return simulation;
}

ComputedMotion Measurement::motion() const {
  return {dynamics_, request_, grid_, *event_rows_, result_.simulation, result_.tolerances, is_stiff_};
}

void Measurement::measure(GivesUp gives_up) {
  may_give_up_ = gives_up == GivesUp::where_it_pays;
  contradicts_ = false;
  doubt_ = 0;
  event_rows_.emplace(grid_.t, result_.simulation);
  result_.events_in_doubt = {};
  result_.events_in_doubt.add(events_lost_in_rounding(motion()));
  result_.events_in_doubt.add(impacts_hidden_at_end(motion()));
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
bool Measurement::is_measured_looser(const std::vector<Simulation>& checks) {
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
std::optional<Tolerances> Measurement::looser_than_needed(const std::vector<Simulation>& checks) const {
  if (!goal_.is_error() || !request_.events.empty() || !event_rows_->events().empty()) return std::nullopt;
  const std::vector<double> difference = largest_differences(motion(), checks.front());
  const std::optional<Tolerances> looser =
      looser_tolerances(result_.tolerances, safety_of_differences * excess(difference), goal_);
  if (!looser) return std::nullopt;
  const std::vector<double> scale = largest_magnitudes(motion(), Rows::wanted);
  for (std::size_t k = 0; k < scale.size(); ++k) {
    const double then = difference[k] * (looser->rtol / result_.tolerances.rtol);
    if (then > 0 && then < near_round_off * scale[k]) return std::nullopt;
  }
  return looser;
}

std::optional<Simulation> Measurement::sharper_motion() {
  SharperMotion sharper = in_more_digits(motion(), left());
  spent_ += sharper.evaluations;
  return std::move(sharper.simulation);
}

/// False where it does not tell the error of the first.
bool Measurement::add_check(std::vector<Simulation>& others, double direction) {
  const ComputedMotion now = motion();
  SimulationRequest request = check_of(now, direction);
  std::optional<ErrorGrowth> growth;
  if (can_give_up()) {
    growth.emplace(now, wanted());
    request.goes_on = [this, &growth](std::size_t first, std::span<const double> rows) {
      return growth->add(first, rows) || !is_enough_to_expect(result_.tolerances, growth->expected());
    };
  }
  const Tolerances tolerances = request.tolerances;
  Simulation& other = others.emplace_back(run(std::move(request)));
  add_hidden_impacts(now, other);
  event_rows_->set_apart(other, request_.y_start.size());
  if (other.method == Method::bdf)
    add_what_is_in_common(now, {largest_magnitudes(now, Rows::all), largest_of_kind(now)}, tolerances, other);
  if (other.ending != Ending::given_up) return can_be_checked_by(other);
  expected_excess_ = growth->expected();
  return false;
}

/// Where a tighter run can be expected to do, and rows at impacts do not differ for another reason.
bool Measurement::can_give_up() const {
  return may_give_up_ && result_.simulation.method == Method::taylor && !motion().is_near_round_off() &&
         result_.simulation.sections.empty() && left() / work_of_all_rungs >= result_.simulation.evaluations;
}

bool Measurement::can_be_checked_by(const Simulation& other) {
  result_.verified_by = other.method;
  result_.bounded = result_.bounded && other.bounded;
  if (const char* reason = not_comparable(motion(), other)) {
    result_.reason = reason;
    return false;
  }
  result_.events_in_doubt.add(differing_events(motion(), other));
  if (result_.simulation.stop && ended_well(other.ending) && !other.stop) {
    result_.reason = accuracy_reasons::went_on;
  }
  return true;
}

/// The last row may be before such an impact or after it.
void Measurement::note_impacts_at_end() {
  std::vector<EventDoubt> doubts = impacts_at_end(motion(), result_.max_abs_error);
  const double end = result_.simulation.t;
  const bool is_row = !grid_.t.empty() && grid_.t.back() == end && grid_.wanted.back();
  const bool is_named = std::ranges::find(result_.at_impacts, end) != result_.at_impacts.end();
  if (!doubts.empty() && is_row && !is_named) result_.at_impacts.push_back(end);
  result_.events_in_doubt.add(std::move(doubts));
}

void Measurement::state(const std::vector<Simulation>& others) {
  const std::string unclear = why_unclear(result_.simulation, others);
  if (!unclear.empty()) {
    result_.reason = unclear;
    return;
  }
  RowComparison comparison = compare(motion(), others, doubt_);
  result_.events_in_doubt.add(events_hidden_by_rounding(motion()));
  result_.events_in_doubt.add(
      events_that_may_happen(motion(), comparison.near_events, comparison.event_errors));
  OtherWays ways = other_ways(motion(), others, comparison, left());
  if (!ways.where.empty()) comparison = with_other_ways(comparison, others, std::move(ways));
  result_.max_abs_error = std::move(comparison.max_abs_error);
  result_.events_in_doubt.add(events_lost_in_errors(motion(), result_.max_abs_error));
  result_.event_errors = std::move(comparison.event_errors);
  result_.events_in_doubt.add(events_that_may_be_several(motion(), result_.event_errors));
  result_.stop_error = comparison.stop_error;
  result_.horizon = comparison.horizon && rests_within_rounding() ? std::nullopt : comparison.horizon;
  result_.at_impacts = std::move(comparison.at_impacts);
  note_impacts_at_end();
  result_.events_in_doubt.add(events_at_end(motion(), result_.max_abs_error));
  if (result_.simulation.stop && !result_.stop_error && result_.reason.empty())
    result_.reason = accuracy_reasons::may_not_stop;
  note_other_conditions();
  take_error_of_stop();
  if (result_.reason.empty() && may_reach_end()) result_.reason = accuracy_reasons::may_reach_end;
  if (result_.reason.empty() && std::ranges::max(result_.max_abs_error) > without_bound)
    result_.reason = accuracy_reasons::forces_are_rounding;
  contradicts_ = !comparison.changed.empty();
  if (contradicts_) result_.reason = accuracy_reasons::contradiction(comparison.changed);
}

void Measurement::note_other_conditions() {
  if (!result_.stop_error) return;
  const OtherConditions others = other_conditions_at_stop(motion(), *result_.stop_error);
  if (others.names.empty()) return;
  result_.stop_error->time = others.time;
  if (result_.reason.empty()) result_.reason = accuracy_reasons::may_fail_before(others.names);
}

/// An event of the same instant may be beyond the last row.
void Measurement::take_error_of_stop() {
  if (!result_.stop_error) return;
  for (std::size_t i = 0; i < result_.event_errors.size(); ++i) {
    const bool is_there = result_.simulation.events[i].t == result_.simulation.stop->t;
    if (is_there && !result_.event_errors[i])
      result_.event_errors[i] = EventError{result_.stop_error->time, {}};
  }
}

bool Measurement::may_reach_end() const {
  const std::optional<Stop>& stop = result_.simulation.stop;
  return stop && result_.stop_error && stop->t + result_.stop_error->time >= request_.t_end;
}

RowComparison Measurement::with_other_ways(const RowComparison& without, std::vector<Simulation> others,
                                           OtherWays ways) {
  spent_ += ways.evaluations;
  std::ranges::move(ways.motions, std::back_inserter(others));
  RowComparison all = compare(motion(), others, doubt_, ways.lost_from);
  if (ways.may_not_end) all.stop_error.reset();
  const std::optional<Stop>& stop = result_.simulation.stop;
  if (all.stop_error && stop->reason == impacts_accumulate)
    all.stop_error->time =
        std::max(all.stop_error->time, of_other_cascades * std::abs(stop->t - ways.first_place));
  const std::string reason = what_they_change(ways, without, all);
  if (!reason.empty()) result_.reason = reason;
  return all;
}

/// The wanted error of each column.
std::vector<double> Measurement::wanted() const {
  std::vector<double> wanted = largest_magnitudes(motion(), Rows::wanted);
  const bool is_relative = goal_.kind == AccuracyGoal::Kind::relative;
  for (double& error : wanted)
    error = !is_relative ? goal_.value : error > 0 ? goal_.value * error : unmeasurable;
  return wanted;
}

/// A column that is 0 to within its error, such as a height above the floor, has no size of its own.
void Measurement::forgive_rounding_of_zeros(const std::vector<double>& error,
                                            std::vector<double>& wanted) const {
  const std::vector<double> size = largest_magnitudes(motion(), Rows::wanted),
                            of_kind = largest_of_kind(motion());
  std::vector<double> at_rest;
  for (std::size_t k = 0; k < error.size(); ++k) {
    if (size[k] > error[k]) continue;
    wanted[k] = std::max(wanted[k], near_round_off * of_kind[k]);
    if (error[k] <= wanted[k]) continue;
    if (at_rest.empty()) at_rest = rounding_at_rest(motion());
    wanted[k] = std::max(wanted[k], at_rest[k]);
  }
}

/// Some columns are 0 to within their errors, which are what rounding makes of rest, and all others are
/// known.
bool Measurement::rests_within_rounding() const {
  const std::vector<double>& error = result_.max_abs_error;
  const std::vector<double> size = largest_magnitudes(motion(), Rows::all);
  const auto is_lost = [&](std::size_t k) { return error[k] > useful_part * size[k]; };
  std::vector<double> at_rest;
  for (std::size_t k = 0; k < error.size(); ++k) {
    if (!is_lost(k)) continue;
    if (size[k] > error[k]) return false;
    if (at_rest.empty()) at_rest = rounding_at_rest(motion());
    if (error[k] > at_rest[k]) return false;
  }
  return !at_rest.empty();
}

/// The same, once the errors are known.
std::vector<double> Measurement::wanted_for(const std::vector<double>& error) const {
  std::vector<double> wanted = this->wanted();
  if (goal_.kind == AccuracyGoal::Kind::relative) forgive_rounding_of_zeros(error, wanted);
  return wanted;
}

/// The largest error in units of what is wanted; 1 is met.
double Measurement::excess(const std::vector<double>& error) const {
  const std::vector<double> wanted = wanted_for(error);
  double largest = 0;
  for (std::size_t k = 0; k < error.size(); ++k) {
    if (error[k] > 0) largest = std::max(largest, error[k] / wanted[k]);
  }
  return largest;
}

void Measurement::thin(Simulation& simulation) const {
  grid_.thin(simulation, request_.y_start.size(), request_.columns.size());
}

}  // namespace qdot
