#include "core/analysis/trajectory_extrema.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace qdot {
namespace {

constexpr Tolerances fine{.rtol = 1e-13, .atol = 1e-15};
constexpr Tolerances coarse{.rtol = 1e-11, .atol = 1e-13};

class Follower {
 public:
  Follower(const Dynamics& dynamics, const ExtremaRequest& request)
      : dynamics_(dynamics), request_(request) {}

  TrajectoryExtrema follow(const Tolerances& tolerances) {
    const Model& model = dynamics_.model();
    const std::string velocity = model.scene.coordinates[request_.coordinate].name + "_dot = 0";
    const std::vector<double> ends{request_.t_end};
    const Simulation motion = simulate(dynamics_, {.parameters = request_.parameters,
                                                   .y_start = request_.y_start,
                                                   .t_start = request_.t_start,
                                                   .t_end = request_.t_end,
                                                   .grid = ends,
                                                   .columns = {},
                                                   .events = {velocity},
                                                   .on_invalid = request_.on_invalid,
                                                   .impacts = request_.impacts,
                                                   .method = Method::erk,
                                                   .tolerances = tolerances,
                                                   .limits = request_.limits});
    look(request_.t_start, request_.y_start[request_.coordinate]);
    for (const EventRecord& event : motion.events) {
      look(event.t, event.y[request_.coordinate]);
      if (event.name != velocity) look(event.t, after_impact(event));
    }
    look(motion.t, motion.y[request_.coordinate]);
    result_.stop = motion.stop;
    result_.ending = motion.ending;
    result_.t = motion.t;
    result_.y = motion.y;
    return std::move(result_);
  }

 private:
  void look(double t, double x) {
    if (!result_.maximum.value || x > *result_.maximum.value) {
      result_.maximum.value = x;
      result_.t_maximum = t;
    }
    if (!result_.minimum.value || x < *result_.minimum.value) {
      result_.minimum.value = x;
      result_.t_minimum = t;
    }
  }

  /// The coordinate after the impact, where the impact map changes it.
  [[nodiscard]] double after_impact(const EventRecord& event) const {
    const Expression q = dynamics_.model().parsed.symbols.coordinates.value[request_.coordinate];
    for (const auto& [symbol, value] : dynamics_.model().parsed.impact) {
      if (symbol == q)
        return values_at(dynamics_, {{"", "", value}}, request_.parameters, event.t, event.y)[0];
    }
    return event.y[request_.coordinate];
  }

  const Dynamics& dynamics_;
  const ExtremaRequest& request_;
  TrajectoryExtrema result_;
};

/// What two integrations disagree about is the error; of motions that end differently nothing is certain.
void estimate(Extremum& extremum, const Extremum& other, bool same_ending) {
  constexpr double round_off = 4 * std::numeric_limits<double>::epsilon();
  extremum.error = std::abs(*extremum.value - *other.value) + round_off * std::abs(*extremum.value);
  if (same_ending) return;
  extremum = {{}, 0, "Two integrations with different tolerances end differently."};
}

}  // namespace

TrajectoryExtrema trajectory_extrema(const Dynamics& dynamics, const ExtremaRequest& request) {
  TrajectoryExtrema result = Follower(dynamics, request).follow(fine);
  const TrajectoryExtrema other = Follower(dynamics, request).follow(coarse);
  const double x0 = request.y_start[request.coordinate];
  if (*result.maximum.value == x0) {
    result.initial = *result.minimum.value == x0 ? InitialPlace::equilibrium : InitialPlace::maximum;
  } else if (*result.minimum.value == x0) {
    result.initial = InitialPlace::minimum;
  }
  const bool same_ending = other.ending == result.ending;
  estimate(result.maximum, other.maximum, same_ending);
  estimate(result.minimum, other.minimum, same_ending);
  return result;
}

}  // namespace qdot
