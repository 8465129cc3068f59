// A Taylor method of order 20 as one writes it for one system: step of Jorba and Zou by one norm, scalar
// arithmetic, samples by Horner's rule on the step's polynomial. The time is exact and the sum of the state
// compensated, as in the project's own, so that their errors have the same floor.

#include <algorithm>
#include <cmath>

#include "tests/bench/work_precision/series.hpp"

namespace qdot::bench {
namespace {

template <class T, unsigned N>
T polynomial(const Series<T, N>& c, T s) {
  T sum = c[N];
  for (unsigned k = N - 1; k >= 1; --k) sum = sum * s + c[k];
  return sum * s;
}

template <class T, unsigned N, std::size_t D>
double step_size(const std::array<Series<T, N>, D>& c, double tolerance) {
  double size = 1, before = 0, last = 0;
  for (const Series<T, N>& row : c) {
    size = std::max(size, std::abs(static_cast<double>(row[0])));
    before = std::max(before, std::abs(static_cast<double>(row[N - 1])));
    last = std::max(last, std::abs(static_cast<double>(row[N])));
  }
  const double w = tolerance * size;
  return std::min(std::pow(w / before, 1.0 / (N - 1)), std::pow(w / last, 1.0 / N));
}

template <class T, unsigned N, template <class, unsigned> class System>
Outcome integrate_series(const Problem& problem, double tolerance) {
  System<T, N> system(problem);
  constexpr std::size_t d = System<T, N>::dimension;
  std::array<T, d> y, carried{};
  std::copy_n(problem.y_start.begin(), d, y.begin());
  std::array<Series<T, N>, d> c{};
  Outcome outcome;
  outcome.states.reserve(samples * d);
  const double t_end = problem.grid.back();
  std::size_t row = 0;
  for (double t = 0;;) {
    system.expand(y, c);
    outcome.evaluations += N;
    ++outcome.steps;
    const double next = std::min(t + step_size<T, N>(c, tolerance), t_end);
    for (; row < samples && problem.grid[row] <= next; ++row) {
      const T s = problem.grid[row] - t;
      for (std::size_t i = 0; i < d; ++i) {
        outcome.states.push_back(static_cast<double>(y[i] + polynomial<T, N>(c[i], s)));
      }
    }
    if (next >= t_end) return outcome;
    const T h = next - t;
    for (std::size_t i = 0; i < d; ++i) {
      const T rise = polynomial<T, N>(c[i], h) + carried[i];
      const T sum = y[i] + rise;
      const T taken = sum - y[i];
      carried[i] = (y[i] - (sum - taken)) + (rise - taken);
      y[i] = sum;
    }
    t = next;
  }
}

template <template <class, unsigned> class System>
Contestant contestant(const Problem& problem) {
  return {"taylor_by_hand", "hand",
          [&problem](double tolerance) { return integrate_series<double, 20, System>(problem, tolerance); }};
}

template <template <class, unsigned> class System>
std::vector<double> reference_by_series(const Problem& problem) {
  return integrate_series<__float128, 30, System>(problem, 1e-25).states;
}

}  // namespace

std::vector<Contestant> hand_written_taylor(const Problem& problem) {
  const std::string& system = problem.motion.system;
  if (system == "spring_pendulum") return {contestant<SpringPendulumSeries>(problem)};
  if (system == "rod_pendulum") return {contestant<RodPendulumSeries>(problem)};
  if (system == "whirling_pendulum") return {contestant<WhirlingPendulumSeries>(problem)};
  if (system == "rod_spring_pendulum") return {contestant<RodSpringPendulumSeries>(problem)};
  return {};
}

std::vector<double> reference(const Problem& problem) {
  const std::string& system = problem.motion.system;
  if (system == "spring_pendulum") return reference_by_series<SpringPendulumSeries>(problem);
  if (system == "rod_pendulum") return reference_by_series<RodPendulumSeries>(problem);
  if (system == "whirling_pendulum") return reference_by_series<WhirlingPendulumSeries>(problem);
  if (system == "rod_spring_pendulum") return reference_by_series<RodSpringPendulumSeries>(problem);
  return tightest_motion(problem);
}

}  // namespace qdot::bench
