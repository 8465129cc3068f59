// The tape's q'' = M^-1 f against the same equations written by hand in C++, with the same elementary
// functions.

#include <benchmark/benchmark.h>
#include <sleef.h>

#include <array>

#include "core/dynamics/dynamics.hpp"
#include "tests/support/scenes.hpp"

namespace qdot {
namespace {

using State = std::array<double, 4>;
using Accelerations = std::array<double, 2>;

/// m 1, k 40, l0 1, g 9.81.
Accelerations spring_pendulum(const std::array<double, 4>& p, const State& y) {
  const auto [m, k, l0, g] = p;
  const auto sc = Sleef_cinz_sincosd1_u10purec(y[1]);
  return {y[0] * y[3] * y[3] + g * sc.y - k / m * (y[0] - l0), -(2 * y[2] * y[3] + g * sc.x) / y[0]};
}

/// m, l, g.
Accelerations rod_pendulum(const std::array<double, 3>& p, const State& y) {
  const auto [m, l, g] = p;
  const auto difference = Sleef_cinz_sincosd1_u10purec(y[0] - y[1]);
  const double s = difference.x, c = difference.y;
  const double f1 = -y[3] * y[3] * s - 1.5 * g / l * Sleef_cinz_sind1_u10purec(y[0]);
  const double f2 = y[2] * y[2] * s - g / l * Sleef_cinz_sind1_u10purec(y[1]);
  const double determinant = 4.0 / 3 - c * c;
  return {(f1 - c * f2) / determinant, (4.0 / 3 * f2 - c * f1) / determinant};
}

/// The state of the next call depends on this one's result, as in an integration.
void feed_back(State& y, const Accelerations& a) {
  y[2] += 1e-9 * a[0];
  y[3] += 1e-9 * a[1];
}

template <class Parameters, class Function>
void run_by_hand(benchmark::State& state, Parameters parameters, State y, Function function) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(parameters);
    feed_back(y, function(parameters, y));
  }
  benchmark::DoNotOptimize(y);
}

void run_tape(benchmark::State& state, const char* system, std::span<const double> parameters, State y) {
  const Dynamics dynamics(test::model_of(system));
  const CompiledFunction& function = dynamics.accelerations();
  Workspace workspace = function.bind(parameters);
  Accelerations a{};
  for (auto _ : state) {
    if (function.evaluate(0, y, workspace, a) != Evaluation::ok) state.SkipWithError("no value");
    feed_back(y, a);
  }
  benchmark::DoNotOptimize(y);
}

constexpr std::array<double, 4> spring_parameters{1, 40, 1, 9.81};
constexpr std::array<double, 3> rod_parameters{1, 1, 9.81};
constexpr State spring_start{1.2, 0.7, 0.1, 0.2};
constexpr State rod_start{0.3, -0.2, 0.1, 0.2};

void accelerations_spring_pendulum_by_hand(benchmark::State& state) {
  run_by_hand(state, spring_parameters, spring_start, spring_pendulum);
}
void accelerations_spring_pendulum_tape(benchmark::State& state) {
  run_tape(state, "spring_pendulum", spring_parameters, spring_start);
}
void accelerations_rod_pendulum_by_hand(benchmark::State& state) {
  run_by_hand(state, rod_parameters, rod_start, rod_pendulum);
}
void accelerations_rod_pendulum_tape(benchmark::State& state) {
  run_tape(state, "rod_pendulum", rod_parameters, rod_start);
}

BENCHMARK(accelerations_spring_pendulum_by_hand);
BENCHMARK(accelerations_spring_pendulum_tape);
BENCHMARK(accelerations_rod_pendulum_by_hand);
BENCHMARK(accelerations_rod_pendulum_tape);

}  // namespace
}  // namespace qdot
