#include "core/motion/trajectory_extrema.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/motion/typed_start.hpp"

namespace qdot {
namespace {

/// One of the two computations.
struct Way {
  Method method;
  Tolerances tolerances;
  bool begins_as_typed;  ///< or where t_start was rounded to
};
constexpr Way fine{Method::taylor, {.rtol = 1e-13, .atol = 1e-15}, true};
constexpr Way coarse{Method::erk, {.rtol = 1e-11, .atol = 1e-13}, false};

constexpr double extremum_round_off = 4 * std::numeric_limits<double>::epsilon();

/// A place where the coordinate may be largest or smallest.
struct PossibleExtremum {
  double t, x;
  double rounding{};  ///< what the rounding of the times of impacts up to here makes of x
};

/// A motion with its candidates, in order of time; there is always one.
struct Followed {
  TrajectoryExtrema ending;
  std::vector<PossibleExtremum> candidates;
};

/// What doubles leave out of numbers is followed so much enlarged, and its effect taken back by as much.
constexpr double enlargement = 4096;

Reals with_enlarged_rest(const Reals& typed) {
  Reals numbers;
  for (std::size_t i = 0; i < typed.size(); ++i) {
    const Real& x = typed.exact(i);
    const double rest = x.low + std::copysign(x.error, x.low);
    numbers.push_back({x.value + enlargement * rest, x.low, x.error});
  }
  return numbers;
}

bool are_doubles(const Reals& typed) {
  for (std::size_t i = 0; i < typed.size(); ++i) {
    if (!typed.exact(i).is_exact()) return false;
  }
  return true;
}

class Follower {
 public:
  Follower(const Dynamics& dynamics, const ExtremaRequest& request)
      : dynamics_(dynamics), request_(request) {}

  Followed follow(const Way& way) {
    const Model& model = dynamics_.model();
    const std::string velocity = model.scene.coordinates[request_.coordinate].name + "_dot = 0";
    const std::vector<double> ends{request_.t_end};
    SimulationRequest asked{.parameters = request_.parameters,
                            .y_start = request_.y_start,
                            .t_start = request_.t_start,
                            .t_start_left_out = request_.t_start_left_out,
                            .t_end = request_.t_end,
                            .grid = ends,
                            .grid_left_out = {},
                            .columns = {},
                            .events = {velocity},
                            .on_invalid = request_.on_invalid,
                            .impacts = request_.impacts,
                            .method = way.method,
                            .tolerances = way.tolerances,
                            .limits = request_.limits};
    if (way.begins_as_typed) asked.y_start = start_as_typed(dynamics_, asked);
    const Simulation motion = simulate(dynamics_, asked);
    look(request_.t_start, request_.y_start[request_.coordinate]);
    for (const EventRecord& event : motion.events) {
      if (event.name == velocity) {
        look(event.t, event.y[request_.coordinate]);
      } else {
        look_at_impact(event);
      }
    }
    look(motion.t, motion.y[request_.coordinate] + (way.begins_as_typed ? rise_to_typed_end(motion) : 0));
    result_.stop = motion.stop;
    result_.ending = motion.ending;
    result_.t = motion.t;
    result_.y = motion.y;
    return {std::move(result_), std::move(candidates_)};
  }

 private:
  /// Of the coordinate, from t_end on.
  [[nodiscard]] double rise_to_typed_end(const Simulation& motion) const {
    const std::size_t n = request_.y_start.size() / 2;
    return motion.t == request_.t_end ? request_.t_end_left_out * motion.y[n + request_.coordinate] : 0;
  }

  void look(double t, double x) {
    candidates_.push_back({t, x, rounding_});
    largest_ = std::max(largest_, std::abs(x));
  }

  /// There x is not flat, and both computations round the time alike.
  void look_at_impact(const EventRecord& event) {
    const double speed = std::abs(event.y[event.y.size() / 2 + request_.coordinate]);
    rounding_ += extremum_round_off * (speed * std::abs(event.t) + largest_);
    look(event.t, event.y[request_.coordinate]);
    look(event.t, after_impact(event));
  }

  /// The coordinate after the impact, where the impact map changes it.
  [[nodiscard]] double after_impact(const EventRecord& event) const {
    const Expression q = dynamics_.model().parsed.symbols.coordinates.value[request_.coordinate];
    for (const ParsedImpact& impact : dynamics_.model().parsed.impacts) {
      if (impact.event != event.name) continue;
      for (const auto& [symbol, value] : impact.map) {
        if (symbol == q)
          return values_at(dynamics_, {{"", "", value}}, request_.parameters, event.t, event.y)[0];
      }
    }
    return event.y[request_.coordinate];
  }

  const Dynamics& dynamics_;
  const ExtremaRequest& request_;
  TrajectoryExtrema result_;
  std::vector<PossibleExtremum> candidates_;
  double rounding_{}, largest_{};
};

/// Up or down: the extremum is the largest of sign x.
double extreme(const Followed& motion, double sign) {
  double most = sign * motion.candidates[0].x;
  for (const PossibleExtremum& candidate : motion.candidates) most = std::max(most, sign * candidate.x);
  return sign * most;
}

/// The first candidate that cannot be told from the extremum; what two integrations disagree about is its
/// error. Of motions that end differently nothing is certain.
PossibleExtremum chosen(const Followed& motion, const Followed& other, const std::optional<Followed>& rounded,
                        double sign, Finding& extremum) {
  const double most = extreme(motion, sign);
  double error = std::abs(most - extreme(other, sign)) + extremum_round_off * std::abs(most);
  if (rounded) {
    const bool ends_alike = rounded->ending.ending == motion.ending.ending;
    error += std::abs(most - extreme(*rounded, sign)) / (ends_alike ? enlargement : 1);
  }
  const PossibleExtremum first =
      *std::find_if(motion.candidates.begin(), motion.candidates.end(),
                    [&](const PossibleExtremum& candidate) { return sign * (most - candidate.x) <= error; });
  error += first.rounding;
  if (motion.ending.ending == other.ending.ending) {
    extremum = {first.x, 2 * error, ""};
  } else {
    extremum.reason = "Two integrations with different tolerances end differently.";
  }
  return first;
}

}  // namespace

TrajectoryExtrema trajectory_extrema(const Dynamics& dynamics, const ExtremaRequest& request) {
  const Followed motion = Follower(dynamics, request).follow(fine);
  const Followed other = Follower(dynamics, request).follow(coarse);
  std::optional<Followed> rounded;
  if (!are_doubles(request.parameters) || !are_doubles(request.y_start)) {
    ExtremaRequest moved = request;
    moved.parameters = with_enlarged_rest(request.parameters);
    moved.y_start = with_enlarged_rest(request.y_start);
    rounded = Follower(dynamics, moved).follow(fine);
  }
  TrajectoryExtrema result = motion.ending;
  const PossibleExtremum top = chosen(motion, other, rounded, 1, result.maximum);
  const PossibleExtremum bottom = chosen(motion, other, rounded, -1, result.minimum);
  result.t_maximum = top.t;
  result.t_minimum = bottom.t;
  if (top.t == request.t_start) {
    result.initial = bottom.t == request.t_start ? InitialPlace::equilibrium : InitialPlace::maximum;
  } else if (bottom.t == request.t_start) {
    result.initial = InitialPlace::minimum;
  }
  return result;
}

}  // namespace qdot
