// Writing a trajectory as JSON against the least that it takes: the same digits by std::to_chars, one after
// the other into a buffer that is large enough.

#include <benchmark/benchmark.h>

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <vector>

#include "api/json/writer.hpp"

namespace qdot {
namespace {

constexpr std::size_t rows = 1001;
constexpr std::array<const char*, 5> names{"t", "l", "theta", "l_dot", "theta_dot"};
constexpr std::size_t longest_number = 32;

/// Numbers with all their digits, as a motion has them.
std::vector<std::vector<double>> trajectory() {
  std::vector<std::vector<double>> columns(names.size(), std::vector<double>(rows));
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = 0.01 * static_cast<double>(i);
    columns[0][i] = t;
    columns[1][i] = 0.5 + 0.05 * std::cos(9 * t);
    columns[2][i] = 0.2 * std::cos(4.3 * t);
    columns[3][i] = -0.45 * std::sin(9 * t);
    columns[4][i] = -0.86 * std::sin(4.3 * t);
  }
  return columns;
}

void count(benchmark::State& state, std::size_t bytes) {
  const auto iterations = static_cast<std::int64_t>(state.iterations());
  state.SetItemsProcessed(iterations * static_cast<std::int64_t>(rows * names.size()));
  state.SetBytesProcessed(iterations * static_cast<std::int64_t>(bytes));
}

void json_trajectory_to_chars(benchmark::State& state) {
  const auto columns = trajectory();
  std::vector<char> buffer(rows * names.size() * longest_number);
  char* end{};
  for (auto _ : state) {
    end = buffer.data();
    for (const std::vector<double>& column : columns) {
      for (const double value : column) {
        end = std::to_chars(end, end + longest_number, value).ptr;
        *end++ = ',';
      }
    }
    benchmark::DoNotOptimize(buffer.data());
    benchmark::ClobberMemory();
  }
  count(state, static_cast<std::size_t>(end - buffer.data()));
}

void write_trajectory(benchmark::State& state, int digits) {
  const auto columns = trajectory();
  std::vector<api::Column> table;
  for (std::size_t k = 0; k < names.size(); ++k) table.push_back({names[k], columns[k]});
  std::size_t bytes{};
  for (auto _ : state) {
    api::JsonWriter writer(api::Layout::compact);
    writer.columns(table, digits);
    const std::string text = std::move(writer).finish();
    bytes = text.size();
    benchmark::DoNotOptimize(text.data());
  }
  count(state, bytes);
}

void json_trajectory(benchmark::State& state) { write_trajectory(state, api::shortest_digits); }
void json_trajectory_10_digits(benchmark::State& state) { write_trajectory(state, 10); }

BENCHMARK(json_trajectory_to_chars)->Unit(benchmark::kMicrosecond);
BENCHMARK(json_trajectory)->Unit(benchmark::kMicrosecond);
BENCHMARK(json_trajectory_10_digits)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace qdot
