// All equilibria of a warm system, the number that makes a position one, and critical values: everything but
// reading the request and writing the answer.

#include <benchmark/benchmark.h>

#include "core/steady/bifurcations.hpp"
#include "core/steady/solve_for.hpp"
#include "tests/support/scenes.hpp"

namespace qdot {
namespace {

struct Warm {
  explicit Warm(const std::string& system, const Values& given = {})
      : model(test::model_of(system)),
        dynamics(model),
        parameters(parameter_values(*model, given)),
        y(initial_state(*model, parameters, given)) {}

  std::shared_ptr<const Model> model;
  Dynamics dynamics;
  std::vector<double> parameters, y;
};

void equilibria_of(benchmark::State& state, const char* system) {
  const Warm warm(system, system == std::string("rolling_disk_platform") ? Values{{"g", 0}} : Values{});
  for (auto _ : state) benchmark::DoNotOptimize(equilibria(warm.dynamics, warm.parameters, warm.y));
}

void solve_for_of(benchmark::State& state, const char* system, const char* unknown) {
  const Warm warm(system, {{"theta", 0.3}});
  for (auto _ : state) benchmark::DoNotOptimize(solve_for(warm.dynamics, warm.parameters, warm.y, unknown));
}

void bifurcations_of(benchmark::State& state, const char* system) {
  const Warm warm(system);
  std::size_t index = 0;
  while (warm.model->scene.parameters[index].name != "Omega") ++index;
  for (auto _ : state) {
    benchmark::DoNotOptimize(bifurcations(warm.dynamics, warm.parameters, warm.y, index, 0, 10));
  }
}

BENCHMARK_CAPTURE(equilibria_of, spring_pendulum, "spring_pendulum");
BENCHMARK_CAPTURE(equilibria_of, forced_spring_pendulum, "forced_spring_pendulum");
BENCHMARK_CAPTURE(equilibria_of, rolling_disk_platform, "rolling_disk_platform");
BENCHMARK_CAPTURE(equilibria_of, cart_pendulum, "cart_pendulum");
BENCHMARK_CAPTURE(equilibria_of, rod_pendulum, "rod_pendulum");
BENCHMARK_CAPTURE(equilibria_of, rod_spring_pendulum, "rod_spring_pendulum");
BENCHMARK_CAPTURE(equilibria_of, whirling_pendulum, "whirling_pendulum");
BENCHMARK_CAPTURE(equilibria_of, orbiting_pendulum, "orbiting_pendulum");
BENCHMARK_CAPTURE(equilibria_of, free_spin_pendulum, "free_spin_pendulum");
BENCHMARK_CAPTURE(equilibria_of, compass_walker, "compass_walker");
BENCHMARK_CAPTURE(equilibria_of, rotating_l_bar, "rotating_l_bar");
BENCHMARK_CAPTURE(equilibria_of, triple_pendulum, "triple_pendulum");
BENCHMARK_CAPTURE(solve_for_of, rotating_l_bar, "rotating_l_bar", "Omega");
BENCHMARK_CAPTURE(solve_for_of, free_spin_pendulum, "free_spin_pendulum", "psi_dot");
BENCHMARK_CAPTURE(bifurcations_of, whirling_pendulum, "whirling_pendulum");
BENCHMARK_CAPTURE(bifurcations_of, rotating_l_bar, "rotating_l_bar");

}  // namespace
}  // namespace qdot
