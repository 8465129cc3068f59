#include "tests/bench/work_precision/motions.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "tests/support/motions.hpp"

namespace qdot::bench {

const std::vector<Motion>& motions() {
  const Values spring{{"m", 1}, {"k", 40}, {"l0", 1}, {"l", 1.2}, {"theta", 0.7}};
  Values stiff = spring;
  stiff["k"] = 1e6;
  stiff["l"] = 1 + 9.81 / 1e6 + 1e-4;
  stiff["theta"] = 0.3;
  static const std::vector<Motion> all{
      {"spring_pendulum", "spring_pendulum", spring, {}, 100},
      {"rod_pendulum", "rod_pendulum", {{"m", 1}, {"l", 1}, {"theta", 0.3}, {"phi", -0.2}}, {}, 100},
      {"whirling_pendulum",
       "whirling_pendulum",
       {{"l", 1}, {"Omega", std::sqrt(19.62)}, {"theta", 1.2}},
       {},
       100},
      {"rod_spring_pendulum", "rod_spring_pendulum", {{"theta", 0.7}, {"phi", -0.4}, {"r", 0.6}}, {}, 20},
      {"stiff_spring_pendulum", "spring_pendulum", stiff, {}, 10},
      {"chaotic_rod_pendulum", "rod_pendulum", {{"m", 1}, {"l", 1}, {"theta", 2}, {"phi", 2}}, {}, 10},
      {"forced_spring_pendulum", "forced_spring_pendulum", {}, {"0.8*cos(4*t)"}, 20},
      {"rolling_disk_platform", "rolling_disk_platform", {{"g", 0}}, {}, 5},
      {"cart_pendulum", "cart_pendulum", {}, {}, 20},
      {"orbiting_pendulum", "orbiting_pendulum", {}, {}, 20},
      {"free_spin_pendulum", "free_spin_pendulum", {}, {}, 20},
      {"compass_walker", "compass_walker", {{"m", 0.05}}, {}, 0.35},
      {"rotating_l_bar", "rotating_l_bar", {}, {}, 20}};
  return all;
}

Problem::Problem(const Motion& of)
    : motion(of),
      dynamics(test::model_of(of.system), of.inputs),
      parameters(parameter_values(dynamics.model(), of.given)),
      y_start(initial_state(dynamics.model(), parameters, of.given)),
      grid(test::instants(of.t_end, samples - 1)) {}

double Problem::parameter(const std::string& name) const {
  std::size_t i = 0;
  while (dynamics.model().scene.parameters[i].name != name) ++i;
  return parameters[i];
}

SimulationRequest Problem::request() const {
  SimulationRequest request;
  request.parameters = parameters;
  request.y_start = y_start;
  request.t_end = grid.back();
  request.grid = grid;
  request.on_invalid = OnInvalid::go_on;
  request.impacts = Impacts::ignore;
  request.method = Method::taylor;
  return request;
}

double seconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double largest_error(const std::vector<double>& states, const std::vector<double>& reference) {
  if (states.size() != reference.size()) return std::nan("");
  double largest = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double error = std::abs(states[i] - reference[i]);
    if (!(error <= largest)) largest = error;
  }
  return largest;
}

}  // namespace qdot::bench
