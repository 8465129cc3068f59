// Turning points by the energy integral on a warm Dynamics, period and validity included.

#include <benchmark/benchmark.h>

#include "core/turning/turning_points.hpp"
#include "tests/support/scenes.hpp"

namespace qdot {
namespace {

void turning_points_of(benchmark::State& state, const char* system, const Values& initial) {
  const Dynamics dynamics(test::model_of(system));
  const std::vector<double> parameters = parameter_values(dynamics.model(), {});
  const std::vector<double> y = initial_state(dynamics.model(), parameters, initial);
  for (auto _ : state) benchmark::DoNotOptimize(turning_points(dynamics, parameters, y));
}

void turning_points_free_spin_pendulum(benchmark::State& state) {
  turning_points_of(state, "free_spin_pendulum", {});
}
void turning_points_orbiting_pendulum(benchmark::State& state) {
  turning_points_of(state, "orbiting_pendulum", {});
}
void turning_points_whirling_pendulum(benchmark::State& state) {
  turning_points_of(state, "whirling_pendulum", {});
}
void turning_points_rotating_l_bar(benchmark::State& state) {
  turning_points_of(state, "rotating_l_bar", {{"theta", 0.4}, {"theta_dot", 0.3}});
}

BENCHMARK(turning_points_free_spin_pendulum);
BENCHMARK(turning_points_orbiting_pendulum);
BENCHMARK(turning_points_whirling_pendulum);
BENCHMARK(turning_points_rotating_l_bar);

}  // namespace
}  // namespace qdot
