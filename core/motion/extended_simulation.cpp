#include "core/motion/extended_simulation.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/row_errors.hpp"
#include "core/motion/useful_part.hpp"
#include "core/motion/winding.hpp"

namespace qdot {
namespace {

constexpr double tightest_of_extended = 1e-31;
constexpr double tightest_extended_check = 1e-33;
constexpr double loosest_of_extended = 1e-14;
constexpr double below_the_error_wanted = 1e-4;
constexpr double extended_rung = 1e-2;  ///< a check's tolerance over that of the run it checks
constexpr double close_to_round_off = 1e-29;
constexpr double caution = 8;                 ///< times a difference: runs round partly alike
constexpr double common_round_off = 0x1p-95;  ///< of a column: what they may have in common
/// Steps are as long as series in doubles can be bounded, which leaves higher orders nothing to gain.
constexpr unsigned highest_bounded_order = 28;
constexpr double least_nudge = 0x1p-105;  ///< relative
constexpr int most_extended_rungs = 3;

constexpr const char* error_not_reached =
    "The error asked for is out of reach for this motion in double-double precision; this is the best found.";
constexpr const char* check_ended_early =
    "The second computation, which would have measured the error, did not come to its end.";

/// The numbers moved, up and down in turn, by what is not known of them: one unit in the last place at least.
std::vector<DoubleDouble> moved(const Reals& numbers, double direction) {
  std::vector<DoubleDouble> result;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const Real& x = numbers.exact(i);
    const double unknown = std::max(x.error, least_nudge * std::abs(x.value));
    result.push_back(x.double_double() + DoubleDouble(direction * unknown));
    if (x.value != 0) direction = -direction;
  }
  return result;
}

/// An instant as it is typed has more digits than are kept, or than are written.
double rounding_of(const Real& t) { return t.error + (t.low == 0 ? 0 : std::abs(t.value) * 0x1p-104); }

class ExtendedLadder {
 public:
  ExtendedLadder(const Dynamics& dynamics, const ExtendedSimulationRequest& request)
      : dynamics_(dynamics), request_(request) {}

  ExtendedSimulation climb() {
    double rtol = tightest_of_extended;
    if (request_.max_error) {
      rtol =
          std::clamp(*request_.max_error * below_the_error_wanted, tightest_of_extended, loosest_of_extended);
    }
    for (int i = 0; i < most_extended_rungs; ++i) {
      measure(rtol);
      if (result_.max_abs_error.empty() || !request_.max_error) break;
      const double error = *std::ranges::max_element(result_.max_abs_error);
      result_.meets_request = error <= *request_.max_error;
      if (*result_.meets_request || rtol <= tightest_of_extended) break;
      rtol = std::max(tightest_of_extended, rtol * std::min(0.1, 0.1 * *request_.max_error / error));
    }
    if (request_.max_error && !result_.meets_request) result_.meets_request = false;
    if (result_.meets_request == false && result_.reason.empty()) result_.reason = error_not_reached;
    result_.evaluations = spent_;
    return std::move(result_);
  }

 private:
  ExtendedRun run(ExtendedMotionRequest motion) {
    motion.t_start = request_.t_start.double_double();
    motion.grid = double_doubles(request_.grid);
    motion.form = ExtendedMotionRequest::Form::full;
    motion.look_for_hidden = true;
    motion.limits = request_.limits;
    motion.limits.max_evaluations -= std::min(motion.limits.max_evaluations, spent_);
    ExtendedRun run = extended_states(dynamics_, motion);
    spent_ += run.evaluations;
    return run;
  }

  void measure(double rtol) {
    result_ = {};
    lost_ = false;
    result_.rtol = rtol;
    ExtendedMotionRequest first = extended_request(request_.parameters, request_.y_start, 0, {});
    first.rtol = rtol;
    const unsigned order = extended_order(rtol, highest_bounded_order);
    first.taylor_order = order;
    first.follow_rounding = true;
    result_.run = run(first);
    if (result_.run.ending != Ending::reached_end) return;
    std::vector<ExtendedRun> others;
    result_.bounded = result_.run.bounded;
    for (const double direction : {1.0, -1.0}) {
      ExtendedMotionRequest other;
      other.parameters = moved(request_.parameters, direction);
      other.y_start = moved(request_.y_start, direction);
      other.rtol = std::max(tightest_extended_check, rtol * extended_rung);
      other.taylor_order = direction > 0 ? order + 3 : order - 2;
      others.push_back(run(other));
      result_.bounded = result_.bounded && others.back().bounded;
      if (others.back().ending != Ending::reached_end) {
        result_.reason = check_ended_early;
        return;
      }
      if (rtol > close_to_round_off) break;
    }
    compare(others);
  }

  /// Errors by the differences in double-doubles, and where the motion is lost by the range of its values.
  void compare(const std::vector<ExtendedRun>& others) {
    const ExtendedRun& first = result_.run;
    const std::size_t width = request_.y_start.size();
    std::vector<double> of_rows(width), scale(width);  // a column may be zero at all rows, and not between
    for (std::size_t k = 0; k < width; ++k) scale[k] = std::abs(request_.y_start[k]);
    for (std::size_t i = 0; i < first.states.size(); ++i) {
      of_rows[i % width] = std::max(of_rows[i % width], std::abs(first.states[i].high));
      scale[i % width] = std::max({scale[i % width], of_rows[i % width], first.passed[i]});
    }
    RowErrors in_doubles(scale, [&] { return winding_coordinates(dynamics_.model()); });
    std::vector<double>& error = result_.max_abs_error;
    error.assign(width, 0.0);
    Workspace workspace = dynamics_.accelerations().bind(request_.parameters);
    for (std::size_t i = 0; i < first.rows; ++i) {
      std::vector<double> row;
      std::vector<std::vector<double>> other_rows(others.size());
      bool is_lost = false;
      for (std::size_t k = 0; k < width; ++k) row.push_back(first.states[i * width + k].high);
      const std::vector<double> by_instant = rounding_of_instant(i, row, workspace);
      for (std::size_t k = 0; k < width; ++k) {
        const DoubleDouble& y = first.states[i * width + k];
        double difference = 0;
        for (std::size_t j = 0; j < others.size(); ++j) {
          const DoubleDouble& other = others[j].states[i * width + k];
          other_rows[j].push_back(other.high);
          difference = std::max(difference, std::abs((y - other).high));
        }
        const double in_forces = first.apart[i * width + k];
        error[k] = std::max(error[k],
                            caution * difference + common_round_off * of_rows[k] + by_instant[k] + in_forces);
        is_lost = is_lost || difference > 1e-3 * scale[k];
      }
      lost_ = lost_ || is_lost;
      std::vector<OtherRow> same_row;
      for (const std::vector<double>& other : other_rows) same_row.push_back({.row = other, .apart = {}});
      in_doubles.add(request_.grid[i], row, same_row);
      if (lost_) {
        for (std::size_t k = 0; k < width; ++k) error[k] = std::max(error[k], in_doubles.so_far()[k]);
      }
      for (std::size_t k = 0; k < width; ++k) {
        if (!result_.horizon && error[k] > useful_part * scale[k]) result_.horizon = i;
      }
    }
  }

  /// What the row's instant and that of the start are not known by moves coordinates with their velocities,
  /// and those with the accelerations: all runs alike.
  [[nodiscard]] std::vector<double> rounding_of_instant(std::size_t row, std::span<const double> y,
                                                        Workspace& workspace) const {
    const std::size_t n = y.size() / 2;
    std::vector<double> off(2 * n), acceleration(n);
    const double unknown = rounding_of(request_.grid.exact(row)) + rounding_of(request_.t_start);
    if (unknown == 0) return off;
    const double t = request_.grid[row];
    if (dynamics_.accelerations().evaluate(t, y, workspace, acceleration) != Evaluation::ok) return off;
    for (std::size_t i = 0; i < n; ++i) {
      off[i] = unknown * std::abs(y[n + i]);
      off[n + i] = unknown * std::abs(acceleration[i]);
    }
    return off;
  }

  const Dynamics& dynamics_;
  const ExtendedSimulationRequest& request_;
  ExtendedSimulation result_;
  std::uint64_t spent_{};
  bool lost_{false};
};

}  // namespace

ExtendedSimulation extended_simulation(const Dynamics& dynamics, const ExtendedSimulationRequest& request) {
  return ExtendedLadder(dynamics, request).climb();
}

}  // namespace qdot
