#include "core/motion/ladder.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/compile/extended/expansion.hpp"
#include "core/motion/extended_motion.hpp"
#include "core/motion/kept_quantities.hpp"
#include "core/motion/row_errors.hpp"
#include "core/motion/stiffness.hpp"

namespace qdot {
namespace {

constexpr double tightest = 1e-15;  ///< rtol of a run that is returned
constexpr double tightest_check = 1e-17;
constexpr double near_round_off = 1e-12;  ///< rtol, or difference of two runs, from which on round-off counts
constexpr double loosest = 1e-2;
constexpr double rung = 1e-2;  ///< a check's tolerance over that of the run it checks
constexpr double check_of_others = 1e-3;
constexpr unsigned order_of_checks = 22;
constexpr unsigned order_of_loose_checks = 18;  ///< of runs that have order 16
constexpr double loose = 1e-6;
constexpr std::size_t instants = 64;  ///< at least so many places are compared
constexpr double useful = 1e-3;       ///< horizon: of a column's largest magnitude
constexpr double aim = 0.2;           ///< of the wanted error, when the next tolerance is chosen
constexpr int most_rungs = 8;
constexpr double dear =
    12;  ///< times the work of a loose run and its check: that of a check in double-doubles
constexpr std::uint64_t cost_of_digits = 3;  ///< of an evaluation in double-doubles
constexpr double stiff = 1e4;  ///< damping times span: Taylor's method would need 1000 steps for stability

constexpr const char* work_spent =
    "The evaluations that a request may take were spent on the way to the error wanted; this is the best "
    "found.";
constexpr const char* out_of_reach =
    "The error wanted is out of reach for this motion in double precision; this is the best found.";
constexpr const char* not_bounded =
    "The error was measured, but not every step has a bound of what it may hide between the places that were "
    "looked at.";

std::string contradiction(const std::string& conserved) {
  return "The answer contradicts itself: " + conserved +
         " is conserved, and changes by more than the errors stated of coordinates and velocities can explain. Do "
         "not rely on them.";
}

bool ended_well(const Simulation& s) { return s.ending == Ending::reached_end || s.ending == Ending::event; }

/// The grid with instants added until there are enough, and which of them were asked for.
struct DenseGrid {
  std::vector<double> t;
  std::vector<bool> wanted;

  explicit DenseGrid(const SimulationRequest& request) : t(request.grid) {
    const double span = (request.grid.empty() ? request.t_end : request.grid.back()) - request.t_start;
    for (std::size_t i = 1; t.size() < instants && i < instants; ++i) {
      t.push_back(request.t_start + span * static_cast<double>(i) / instants);
    }
    std::sort(t.begin(), t.end());
    t.erase(std::unique(t.begin(), t.end()), t.end());
    for (const double instant : t) {
      wanted.push_back(std::binary_search(request.grid.begin(), request.grid.end(), instant));
    }
  }
};

/// Only the rows that were asked for.
void thin(std::vector<double>& rows, std::size_t count, std::size_t width, const std::vector<bool>& wanted) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!wanted[i]) continue;
    std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                rows.begin() + static_cast<std::ptrdiff_t>(kept++ * width));
  }
  rows.resize(kept * width);
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
      if (goal_.verify && ended_well(result_.simulation)) measure();
      return finished();
    }
    Tolerances next = start();
    for (int i = 0; i < most_rungs; ++i) {
      take(next);
      if (!ended_well(result_.simulation)) break;
      measure();
      if (keep_best() || result_.max_abs_error.empty() || next.rtol <= tightest) break;
      const auto wanted = tighter(next);
      if (!wanted) break;
      next = *wanted;
    }
    if (best_) result_ = std::move(*best_);
    return finished();
  }

 private:
  using Kind = AccuracyGoal::Kind;

  /// A tolerance that is likely to do: errors are ten to a thousand times the tolerance. Where it would be so
  /// tight that the check takes double-doubles, ten times that is tried first.
  [[nodiscard]] Tolerances start() const {
    if (goal_.kind == Kind::work) return with_rtol(loosest);
    const double likely = std::max(goal_.value * 1e-3, std::min(goal_.value * 1e-2, 10 * near_round_off));
    return with_rtol(std::clamp(likely, tightest, loosest));
  }

  [[nodiscard]] static Tolerances with_rtol(double rtol) { return {rtol, rtol * 1e-3}; }

  [[nodiscard]] std::uint64_t left() const {
    const std::uint64_t allowed =
        goal_.kind == Kind::work ? goal_.evaluations : request_.limits.max_evaluations;
    return allowed - std::min(allowed, spent_);
  }

  Simulation run(SimulationRequest request) {
    request.grid = grid_.t;
    request.limits.max_evaluations = std::min(request.limits.max_evaluations, left());
    Simulation simulation = simulate(dynamics_, request);
    spent_ += simulation.evaluations;
    return simulation;
  }

  void take(const Tolerances& tolerances) {
    SimulationRequest request = request_;
    request.tolerances = tolerances;
    if (is_stiff_ && request.method == Method::taylor) request.method = Method::bdf;
    result_ = {};
    result_.tolerances = tolerances;
    result_.simulation = run(std::move(request));
    result_.bounded = result_.simulation.bounded;
  }

  /// The second road: another order where the method is taylor, another method elsewhere; from parameters and
  /// initial values moved in their last bits, up (1) or down (-1).
  [[nodiscard]] SimulationRequest check(double direction) const {
    SimulationRequest request = request_;
    request.columns.clear();
    request.events.clear();
    const Method first = result_.simulation.method;
    const bool same = first == Method::taylor;
    request.method = second_method();
    const bool is_loose = first != Method::gauss && result_.tolerances.rtol >= loose;
    request.taylor_order = is_loose ? order_of_loose_checks : order_of_checks;
    const double least = is_stiff_ ? 1e-14 : tightest_check;
    // What a fixed step comes to is not known before: its check is as tight as can be.
    const double factor = first == Method::gauss ? 0 : same ? rung : check_of_others;
    const double rtol = std::max(least, result_.tolerances.rtol * factor);
    request.tolerances = {rtol, std::max(result_.tolerances.atol * factor, least * 1e-3)};
    nudge(request.parameters, direction);
    nudge(request.y_start, direction);
    return request;
  }

  [[nodiscard]] bool is_near_round_off() const {
    return result_.simulation.method == Method::gauss || result_.tolerances.rtol <= near_round_off;
  }

  /// One check tells the error of truncation. Where round-off is as large, a single difference may be small
  /// by chance; two checks that start on either side cannot both be.
  [[nodiscard]] bool one_is_enough(const Simulation& other) const {
    const std::size_t width = request_.y_start.size();
    for (std::size_t k = 0; k < width; ++k) {
      double difference = 0, size = 0;
      bool varies = false;
      for (std::size_t i = k; i < std::min(result_.simulation.states.size(), other.states.size());
           i += width) {
        difference = std::max(difference, std::abs(result_.simulation.states[i] - other.states[i]));
        size = std::max(size, std::abs(result_.simulation.states[i]));
        varies = varies || result_.simulation.states[i] != result_.simulation.states[k];
      }
      if (varies && difference <= near_round_off * size) return false;
    }
    return true;
  }

  [[nodiscard]] Method second_method() const { return is_stiff_ ? Method::bdf : Method::taylor; }

  /// Every number by one or two units in the last place, up and down in turn, so that the ratio of any two
  /// near each other moves as well: what rounding does to the motion, the rounding that all runs have in
  /// common included. It is nothing beside any other error.
  static void nudge(Reals& numbers, double direction) {
    double towards = direction * infinity;
    std::size_t moved = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      double x = numbers[i];
      if (x == 0) continue;
      x = std::nextafter(x, towards);
      if (moved++ % 4 >= 2) x = std::nextafter(x, towards);
      numbers.set(i, x);
      towards = -towards;
    }
  }

  void measure() {
    contradicts_ = false;
    doubt_ = 0;
    const bool is_near = is_near_round_off();
    std::optional<Simulation> sharper;
    if (is_near) sharper = in_more_digits();
    if (sharper && !result_.simulation.stop) {
      result_.verified_by = Method::taylor;
      return compare({std::move(*sharper)});
    }
    std::vector<Simulation> others;
    if (!add_check(others, 1)) return;
    if (is_near || !one_is_enough(others.front())) {
      if (!is_near) sharper = in_more_digits();
      if (sharper) {
        others.push_back(std::move(*sharper));
      } else if (left() < 2 * others.front().evaluations) {
        doubt_ = near_round_off;  // no work is left to tell how much less it is
      } else if (!add_check(others, -1)) {
        return;
      }
    }
    compare(others);
  }

  /// False where it does not tell the error of the first.
  bool add_check(std::vector<Simulation>& others, double direction) {
    const SimulationRequest request = check(direction);
    result_.verified_by = request.method;
    const Simulation& other = others.emplace_back(run(request));
    result_.bounded = result_.bounded && other.bounded;
    if (const char* reason = not_comparable(other)) {
      result_.reason = reason;
      return false;
    }
    if (result_.simulation.stop && ended_well(other) && !other.stop) {
      result_.reason =
          "The second computation went on beyond the end of this one: that it stops here is no more "
          "certain than its error allows.";
    }
    return true;
  }

  /// The motion from the numbers as they were typed, in so many digits that the difference is what rounding
  /// did to it. None where it has impacts, where something may lie hidden, or where that is too much work.
  std::optional<Simulation> in_more_digits() {
    const Simulation& first = result_.simulation;
    const bool is_smooth = first.sections.empty() && dynamics_.kinks() == nullptr &&
                           has_extended_expansion(dynamics_.accelerations());
    if (is_stiff_ || !is_smooth || first.rows == 0) return std::nullopt;
    ExtendedMotionRequest request = extended_request(request_.parameters, request_.y_start, request_.t_start,
                                                     std::span(grid_.t).first(first.rows));
    request.look_for_hidden = true;
    request.limits.max_evaluations = left() / cost_of_digits;
    const ExtendedRun run = extended_states(dynamics_, request);
    spent_ += cost_of_digits * run.evaluations;
    if (run.rows < first.rows || !run.bounded) return std::nullopt;
    Simulation result;
    result.rows = run.rows;
    for (const DoubleDouble& x : run.states) result.states.push_back(x.value());
    return result;
  }

  void compare(const std::vector<Simulation>& others) {
    const Simulation& first = result_.simulation;
    const std::size_t width = request_.y_start.size();
    std::size_t rows = first.rows;
    for (const Simulation& other : others) rows = std::min(rows, other.rows);
    const std::vector<double> largest = largest_magnitudes(Rows::all);
    RowErrors errors(largest);
    const std::vector<double> scale = largest_magnitudes(Rows::wanted);
    result_.max_abs_error.assign(width, 0.0);
    std::vector<double> stated;  // of each row
    Workspace workspace = dynamics_.accelerations().bind(request_.parameters);
    for (std::size_t i = 0; i < rows; ++i) {
      std::vector<std::span<const double>> same_row;
      for (const Simulation& other : others)
        same_row.push_back(std::span(other.states).subspan(i * width, width));
      std::vector<double> missed = unseen_at(others, i);
      add_rounding_of_instant(i, workspace, missed);
      errors.add(std::span(first.states).subspan(i * width, width), same_row, missed);
      stated.insert(stated.end(), errors.so_far().begin(), errors.so_far().end());
      if (!grid_.wanted[i]) continue;
      result_.max_abs_error = errors.so_far();
      for (std::size_t k = 0; k < width; ++k) result_.max_abs_error[k] += doubt_ * largest[k];
      note_horizon(i, result_.max_abs_error, scale);
    }
    for (std::size_t i = 0; i < stated.size(); ++i) stated[i] += doubt_ * largest[i % width];
    look_for_contradiction(stated);
  }

  /// What is conserved must not change by more than the errors stated of the rows allow.
  void look_for_contradiction(std::span<const double> stated) {
    const Simulation& first = result_.simulation;
    const std::size_t rows = stated.size() / request_.y_start.size();
    const std::string changed =
        changed_conserved_quantity(dynamics_, request_.parameters,
                                   {.t_start = request_.t_start,
                                    .start = request_.y_start,
                                    .t = std::span(grid_.t).first(rows),
                                    .states = std::span(first.states).first(stated.size()),
                                    .errors = stated},
                                   first.sections);
    contradicts_ = !changed.empty();
    if (contradicts_) result_.reason = contradiction(changed);
  }

  /// A row is where its instant has been rounded to, and was asked for at a decimal: by so much the motion
  /// goes on in between.
  void add_rounding_of_instant(std::size_t row, Workspace& workspace, std::vector<double>& missed) const {
    const double t = grid_.t[row];
    const double in_parts = std::ldexp(t, 20);
    if (in_parts == std::nearbyint(in_parts)) return;  // as it was typed
    const std::size_t width = request_.y_start.size(), n = width / 2;
    const std::span<const double> y = std::span(result_.simulation.states).subspan(row * width, width);
    std::vector<double> acceleration(n);
    if (dynamics_.accelerations().evaluate(t, y, workspace, acceleration) != Evaluation::ok) return;
    missed.resize(width);
    const double rounded = (std::nextafter(std::abs(t), infinity) - std::abs(t)) / 2;
    for (std::size_t i = 0; i < n; ++i) {
      missed[i] += rounded * std::abs(y[n + i]);
      missed[n + i] += rounded * std::abs(acceleration[i]);
    }
  }

  /// What the checks may have missed up to a row.
  [[nodiscard]] std::vector<double> unseen_at(const std::vector<Simulation>& others, std::size_t row) const {
    const std::size_t width = request_.y_start.size();
    std::vector<double> unseen;
    for (const Simulation& other : others) {
      if (other.unseen.empty()) continue;
      unseen.resize(width);
      for (std::size_t k = 0; k < width; ++k) unseen[k] = std::max(unseen[k], other.unseen[row * width + k]);
    }
    return unseen;
  }

  /// Why the second run does not tell the error of the first.
  [[nodiscard]] const char* not_comparable(const Simulation& second) const {
    const auto begin = grid_.wanted.begin();
    const auto from = static_cast<std::ptrdiff_t>(second.rows);
    const auto to = static_cast<std::ptrdiff_t>(result_.simulation.rows);
    if (from >= to || std::find(begin + from, begin + to, true) == begin + to) return nullptr;
    if (ended_well(second)) {
      return "The second computation stopped before this one: whether the motion goes so far is no more "
             "certain than its error allows, which could not be measured.";
    }
    if (second.ending == Ending::step_limit) {
      return "The steps or evaluations allowed were spent before the second computation, which would have "
             "measured the error, came to its end.";
    }
    return "The second computation, which would have measured the error, did not come to its end.";
  }

  void note_horizon(std::size_t row, const std::vector<double>& error, const std::vector<double>& scale) {
    if (result_.horizon) return;
    for (std::size_t k = 0; k < error.size(); ++k) {
      if (error[k] > useful * scale[k]) result_.horizon = grid_.t[row];
    }
  }

  enum class Rows { all, wanted };

  /// Of each column.
  [[nodiscard]] std::vector<double> largest_magnitudes(Rows which) const {
    const std::size_t width = request_.y_start.size();
    const Simulation& first = result_.simulation;
    std::vector<double> largest(width);
    for (std::size_t i = 0; i < first.rows * width; ++i) {
      if (which == Rows::wanted && !grid_.wanted[i / width]) continue;
      largest[i % width] = std::max(largest[i % width], std::abs(first.states[i]));
    }
    return largest;
  }

  /// The largest error in units of what is wanted; 1 is met.
  [[nodiscard]] double excess() const {
    const std::vector<double> scale = largest_magnitudes(Rows::wanted);
    double largest = 0;
    for (std::size_t k = 0; k < result_.max_abs_error.size(); ++k) {
      const double wanted = goal_.value * (goal_.kind == Kind::relative ? scale[k] : 1.0);
      if (result_.max_abs_error[k] > 0) largest = std::max(largest, result_.max_abs_error[k] / wanted);
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
    const double now = excess();
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
      const double factor = std::clamp(aim / excess_, 1e-6, 0.1);
      return with_rtol(std::max(tightest, now.rtol * factor));
    }
    // A run and its check cost twice as much as now when the tolerance goes down by this factor.
    const double cost = static_cast<double>(best_->simulation.evaluations) * 2.4;
    const double growth = static_cast<double>(left()) / cost;
    if (growth < 1) return std::nullopt;
    const double factor = evaluate(Function::exp, -15 * evaluate(Function::log, growth));
    // Near round-off a check takes double-doubles, and several times the work.
    const double least = growth < dear ? 100 * near_round_off : tightest;
    if (now.rtol <= least) return std::nullopt;
    return with_rtol(std::clamp(now.rtol * factor, least, std::max(least, now.rtol * 0.1)));
  }

  MeasuredSimulation finished() {
    Simulation& s = result_.simulation;
    const std::size_t rows = s.rows;
    thin(s.states, rows, request_.y_start.size(), grid_.wanted);
    thin(s.columns, rows, request_.columns.size(), grid_.wanted);
    s.rows = static_cast<std::size_t>(
        std::count(grid_.wanted.begin(), grid_.wanted.begin() + static_cast<std::ptrdiff_t>(rows), true));
    result_.evaluations = spent_;
    const bool error_wanted = goal_.kind == Kind::absolute || goal_.kind == Kind::relative;
    if (error_wanted && result_.max_abs_error.empty()) {
      result_.meets_request = false;  // for the reason that there is already
    } else if (result_.meets_request == false && result_.reason.empty()) {
      const bool work_is_spent =
          doubt_ > 0 || (result_.tolerances.rtol > tightest && left() < result_.simulation.evaluations);
      result_.reason = !result_.bounded ? not_bounded : work_is_spent ? work_spent : out_of_reach;
    }
    return std::move(result_);
  }

  const Dynamics& dynamics_;
  const SimulationRequest& request_;
  const AccuracyGoal& goal_;
  DenseGrid grid_;
  bool is_stiff_;  ///< explicit methods are of no use
  MeasuredSimulation result_;
  std::optional<MeasuredSimulation> best_;
  double best_excess_{}, excess_{};
  bool contradicts_{false}, best_contradicts_{false};  ///< what is conserved has changed
  double doubt_{};                                     ///< of each column: round-off that was not measured
  std::uint64_t spent_{};
};

}  // namespace

MeasuredSimulation simulate_with_error(const Dynamics& dynamics, const SimulationRequest& request,
                                       const AccuracyGoal& goal) {
  if (request.method == Method::gauss && goal.kind != AccuracyGoal::Kind::tolerances) {
    throw std::invalid_argument("gauss has a step and no goal");
  }
  return Ladder(dynamics, request, goal).climb();
}

}  // namespace qdot
