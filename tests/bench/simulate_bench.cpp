// A whole request, from bytes to bytes, against the least that it takes: the motion's own integration and its
// numbers as text. Spring pendulum over 100 s, error about 1e-6, 1001 rows of 5 columns, without the second
// run.

#include <benchmark/benchmark.h>

#include <array>
#include <charconv>

#include "api/service.hpp"
#include "core/compile/taylor/expansion.hpp"
#include "core/integrate/integrate.hpp"
#include "tests/support/motions.hpp"

namespace qdot {
namespace {

constexpr double t_end = 100, rtol = 1e-8;
constexpr std::size_t rows = 1001;
const Values given{{"m", 1}, {"k", 40}, {"l0", 1}, {"l", 1.2}, {"theta", 0.7}};

void simulate_request(benchmark::State& state) {
  const api::Service service;
  const api::Request request{
      .method = "POST",
      .target = "/v1/simulate",
      .headers = {{"content-type", "application/json"}},
      .body = R"({"system": "spring_pendulum", "parameters": {"m": 1, "k": 40, "l0": 1},
                  "initial": {"l": 1.2, "theta": 0.7}, "t_end": 100, "samples": 1001, "rtol": 1e-8,
                  "verify": false})"};
  if (service.handle(request).status != 200) state.SkipWithError("refused");
  for (auto _ : state) benchmark::DoNotOptimize(service.handle(request).body.data());
}

void simulate_solve_and_to_chars(benchmark::State& state) {
  const auto model = test::model_of("spring_pendulum");
  const Dynamics dynamics(model);
  const std::vector<double> parameters = parameter_values(*model, given);
  TaylorExpansion expansion(dynamics.accelerations(), parameters);
  RightHandSide system{.dimension = 4};
  system.expansion = [&expansion](double t, std::span<const double> y, unsigned order, std::span<double> c) {
    return expansion.expand(t, y, order, c);
  };
  const std::vector<double> grid = test::instants(t_end, rows - 1);
  RunRequest request{.y_start = initial_state(*model, parameters, given), .t_end = t_end, .grid = grid};
  request.method = Method::taylor;
  request.tolerances = {rtol, 1e-12};
  std::vector<char> text(rows * 5 * 32);
  for (auto _ : state) {
    const Run run = integrate(system, request);
    char* end = text.data();
    const auto write = [&end](double value) {
      end = std::to_chars(end, end + 32, value).ptr;
      *end++ = ',';
    };
    for (const double t : grid) write(t);
    for (const double value : run.states) write(value);
    benchmark::DoNotOptimize(text.data());
  }
}

BENCHMARK(simulate_solve_and_to_chars)->Unit(benchmark::kMicrosecond);
BENCHMARK(simulate_request)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace qdot
