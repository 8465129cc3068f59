// Small oscillations on a warm system: everything but reading the request and writing the answer.

#include <benchmark/benchmark.h>

#include "core/steady/modes.hpp"
#include "tests/support/scenes.hpp"

namespace qdot {
namespace {

void modes_of(benchmark::State& state, const char* system) {
  const auto model = test::model_of(system);
  const Dynamics dynamics(model);
  const Values given = system == std::string("rolling_disk_platform") ? Values{{"g", 0}} : Values{};
  const std::vector<double> parameters = parameter_values(*model, given);
  const std::vector<double> initial = initial_state(*model, parameters, given);
  for (auto _ : state) benchmark::DoNotOptimize(normal_modes(dynamics, parameters, initial));
}

BENCHMARK_CAPTURE(modes_of, spring_pendulum, "spring_pendulum");
BENCHMARK_CAPTURE(modes_of, forced_spring_pendulum, "forced_spring_pendulum");
BENCHMARK_CAPTURE(modes_of, rolling_disk_platform, "rolling_disk_platform");
BENCHMARK_CAPTURE(modes_of, cart_pendulum, "cart_pendulum");
BENCHMARK_CAPTURE(modes_of, rod_pendulum, "rod_pendulum");
BENCHMARK_CAPTURE(modes_of, rod_spring_pendulum, "rod_spring_pendulum");
BENCHMARK_CAPTURE(modes_of, whirling_pendulum, "whirling_pendulum");
BENCHMARK_CAPTURE(modes_of, orbiting_pendulum, "orbiting_pendulum");
BENCHMARK_CAPTURE(modes_of, free_spin_pendulum, "free_spin_pendulum");
BENCHMARK_CAPTURE(modes_of, compass_walker, "compass_walker");
BENCHMARK_CAPTURE(modes_of, rotating_l_bar, "rotating_l_bar");
BENCHMARK_CAPTURE(modes_of, foucault, "foucault");
BENCHMARK_CAPTURE(modes_of, triple_pendulum, "triple_pendulum");

}  // namespace
}  // namespace qdot
