#include "core/motion/trajectory_extrema.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <tuple>

#include "core/motion/ladder.hpp"
#include "core/motion/resolved_size.hpp"
#include "core/motion/simulation.hpp"
#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

constexpr Tolerances tolerances_of_extrema{.rtol = 1e-15, .atol = 1e-17};
constexpr double worth_another =
    1e-10;  ///< of the largest |x|: an error that an earlier end may make smaller
constexpr std::array shares_at_stop{1e-9, 1e-6, 1e-3};
constexpr double rounding_of_map = 4 * std::numeric_limits<double>::epsilon();

/// A place where the coordinate may be largest or smallest.
struct PossibleExtremum {
  double t{}, x{};
  double speed{};                      ///< of the coordinate
  std::optional<std::size_t> event{};  ///< that tells it, of the motion's; none at its ends
  bool is_mapped{};                    ///< an impact has made x of several coordinates
};

/// The motion's own, in order of time; there is always one.
class Candidates {
 public:
  Candidates(const Dynamics& dynamics, const SimulationRequest& request, std::size_t coordinate)
      : dynamics_(dynamics), request_(request), coordinate_(coordinate) {}

  std::vector<PossibleExtremum> of(const Simulation& motion) {
    look(request_.t_start, request_.y_start, {});
    for (std::size_t i = 0; i < motion.events.size(); ++i) {
      const EventRecord& event = motion.events[i];
      look(event.t, event.y, i);
      if (event.name != request_.events.front()) look_behind(event, i);
    }
    look(motion.t, motion.y, {});
    return std::move(all_);
  }

 private:
  void look(double t, std::span<const double> y, std::optional<std::size_t> event) {
    all_.push_back({t, y[coordinate_], std::abs(y[y.size() / 2 + coordinate_]), event, false});
  }

  /// The coordinate after the impact, where the impact map changes it.
  void look_behind(const EventRecord& event, std::size_t number) {
    const Expression q = dynamics_.model().parsed.symbols.coordinates.value[coordinate_];
    for (const ParsedImpact& impact : dynamics_.model().parsed.impacts) {
      if (impact.event != event.name) continue;
      for (const auto& [symbol, value] : impact.map) {
        if (!(symbol == q)) continue;
        const double x = values_at(dynamics_, {{"", "", value}}, request_.parameters, event.t, event.y)[0];
        all_.push_back({event.t, x, all_.back().speed, number, true});
      }
    }
  }

  const Dynamics& dynamics_;
  const SimulationRequest& request_;
  std::size_t coordinate_;
  std::vector<PossibleExtremum> all_;
};

/// None hides a motion that begins small.
Tolerances tolerances_for(std::span<const double> start) {
  const auto [rtol, atol] = tolerances_of_extrema;
  return {.rtol = rtol, .atol = std::min(atol, rtol * resolved_size(start))};
}

SimulationRequest motion_of(const Dynamics& dynamics, const ExtremaRequest& request) {
  const std::string name = dynamics.model().scene.coordinates[request.coordinate].name;
  return {.parameters = request.parameters,
          .y_start = request.y_start,
          .t_start = request.t_start,
          .t_start_left_out = request.t_start_left_out,
          .t_end = request.t_end,
          .grid = {request.t_end},
          .grid_left_out = {},
          .columns = {},
          .events = {name + "_dot = 0"},
          .on_invalid = request.on_invalid,
          .impacts = request.impacts,
          .method = Method::taylor,
          .tolerances = tolerances_for(request.y_start),
          .limits = request.limits};
}

class Extrema {
 public:
  Extrema(const Dynamics& dynamics, const ExtremaRequest& request)
      : dynamics_(dynamics), request_(request), asked_(motion_of(dynamics, request)) {}

  TrajectoryExtrema found() {
    measured_.simulation = simulate(dynamics_, asked_);
    take_ending();
    if (!ended_well(result_.ending)) return std::move(result_);
    all_ = Candidates(dynamics_, asked_, request_.coordinate).of(measured_.simulation);
    measure(all_.size() - 1);
    std::tie(result_.maximum, result_.t_maximum, result_.t_maximum_error) = extremum(1);
    std::tie(result_.minimum, result_.t_minimum, result_.t_minimum_error) = extremum(-1);
    name_start();
    return std::move(result_);
  }

 private:
  using Found = std::tuple<Finding, double, std::optional<double>>;

  void take_ending() {
    const Simulation& motion = measured_.simulation;
    result_.stop = motion.stop;
    result_.ending = motion.ending;
    result_.t = motion.t;
    result_.y = motion.y;
  }

  /// The motion once more with its errors, up to behind that candidate: the time of an event at the last row
  /// has none. Where the motion stops another computation may stop earlier.
  void measure(std::size_t last) {
    for (const double share : shares_at_stop) {
      measure_up_to(last, share);
      if (!measured_.max_abs_error.empty() || !result_.stop) return;
    }
  }

  void measure_up_to(std::size_t last, double share) {
    SimulationRequest to_there = asked_;
    std::vector<double>& grid = to_there.grid;
    grid.clear();
    last_row_ = result_.stop
                    ? result_.t - std::max(2 * result_.stop->doubt, share * (result_.t - request_.t_start))
                    : result_.t;
    for (const PossibleExtremum& one : std::span(all_).first(std::min(last + 2, all_.size())))
      grid.push_back(std::max(request_.t_start, std::min(one.t, last_row_)));
    grid.erase(std::unique(grid.begin(), grid.end()), grid.end());
    if (grid.back() == request_.t_end) {
      to_there.grid_left_out.assign(grid.size(), 0);
      to_there.grid_left_out.back() = request_.t_end_left_out;
    }
    if (last + 2 < all_.size()) to_there.t_end = grid.back();
    measured_ = simulate_with_error(dynamics_, to_there, {});
    last_measured_ = last;
    known_times_.clear();
    for (const PossibleExtremum& one : all_) {
      if (time_error(one)) known_times_.push_back(one.t);
    }
    std::ranges::sort(known_times_);
  }

  /// Of x at a candidate, and of x where the motion really has its event.
  [[nodiscard]] double error_of(const PossibleExtremum& one) const {
    const std::vector<double>& of_rows = measured_.max_abs_error;
    const std::size_t n = of_rows.size() / 2;
    double error = of_rows[request_.coordinate];
    if (one.is_mapped) {
      error = rounding_of_map * std::abs(one.x);
      for (std::size_t i = 0; i < n; ++i) error += of_rows[i];
    }
    const double speed = one.speed + of_rows[n + request_.coordinate];
    if (one.t > last_row_) error += speed * (one.t - last_row_);
    return one.event ? error + speed * time_error(one).value_or(time_around(one)) : error;
  }

  /// In which an event lies whose time has no error: from the event before to the one after, and twice
  /// that because its speed may change.
  [[nodiscard]] double time_around(const PossibleExtremum& one) const {
    constexpr double safety = 2;
    const auto first = std::ranges::lower_bound(known_times_, one.t);
    const auto after = std::ranges::upper_bound(known_times_, one.t);
    const double begin = first == known_times_.begin() ? request_.t_start : *std::prev(first);
    const double end = after == known_times_.end() ? result_.t : *after;
    return safety * (std::min(end, result_.t) - std::max(begin, request_.t_start));
  }

  [[nodiscard]] std::optional<double> time_error(const PossibleExtremum& one) const {
    if (!one.event && result_.stop && one.t == result_.t) return time_in(measured_.stop_error);
    if (!one.event) return one.t == request_.t_end ? std::abs(request_.t_end_left_out) : 0;
    const auto& errors = measured_.event_errors;
    return *one.event < errors.size() ? time_in(errors[*one.event]) : std::nullopt;
  }

  [[nodiscard]] static std::optional<double> time_in(const std::optional<EventError>& error) {
    return error ? std::optional(error->time) : std::nullopt;
  }

  /// Up or down: the largest of sign x. The first candidate that may be it.
  Found extremum(double sign) {
    const std::size_t top = largest(sign);
    if (measured_.max_abs_error.empty()) return {{std::nullopt, 0, measured_.reason}, all_[top].t, {}};
    const double size = std::max(std::abs(all_[largest(1)].x), std::abs(all_[largest(-1)].x));
    const bool is_worth = error_of(all_[top]) > worth_another * size && is_beyond_those_after(top, sign);
    if (last_measured_ != (is_worth ? top : all_.size() - 1)) measure(is_worth ? top : all_.size() - 1);
    if (measured_.max_abs_error.empty()) return {{std::nullopt, 0, measured_.reason}, all_[top].t, {}};
    double least = -infinity, most = -infinity;
    for (const PossibleExtremum& one : measured_ones()) {
      least = std::max(least, sign * one.x - error_of(one));
      most = std::max(most, sign * one.x + error_of(one));
    }
    const auto first = std::ranges::find_if(
        measured_ones(), [&](const auto& one) { return sign * one.x + error_of(one) >= least; });
    const double error = std::max(most - sign * first->x, sign * first->x - least);
    return {{first->x, error, measured_.reason}, first->t, time_error(*first)};
  }

  [[nodiscard]] std::span<const PossibleExtremum> measured_ones() const {
    return std::span(all_).first(last_measured_ + 1);
  }

  [[nodiscard]] std::size_t largest(double sign) const {
    const auto top = std::ranges::max_element(all_, {}, [=](const auto& one) { return sign * one.x; });
    return static_cast<std::size_t>(top - all_.begin());
  }

  [[nodiscard]] bool is_beyond_those_after(std::size_t top, double sign) const {
    if (top + 1 == all_.size() || all_[top].t == request_.t_start || last_measured_ + 1 < all_.size())
      return false;
    return std::ranges::all_of(std::span(all_).subspan(top + 1), [&](const auto& one) {
      return sign * one.x + error_of(one) < sign * all_[top].x;
    });
  }

  void name_start() {
    const bool is_top = result_.t_maximum == request_.t_start,
               is_bottom = result_.t_minimum == request_.t_start;
    if (is_top)
      result_.initial = is_bottom ? InitialPlace::equilibrium : InitialPlace::maximum;
    else if (is_bottom)
      result_.initial = InitialPlace::minimum;
  }

  const Dynamics& dynamics_;
  const ExtremaRequest& request_;
  SimulationRequest asked_;
  std::vector<PossibleExtremum> all_;
  std::vector<double> known_times_;  ///< of those whose times have errors, in order
  MeasuredSimulation measured_;
  std::size_t last_measured_{};
  double last_row_{};
  TrajectoryExtrema result_;
};

}  // namespace

TrajectoryExtrema trajectory_extrema(const Dynamics& dynamics, const ExtremaRequest& request) {
  return Extrema(dynamics, request).found();
}

}  // namespace qdot
