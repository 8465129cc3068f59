// The ladder on the same motions, through simulate_with_error() as a request to `simulate` uses it.

#include <algorithm>
#include <cmath>
#include <ostream>

#include "core/motion/ladder.hpp"
#include "tests/bench/work_precision/motions.hpp"

namespace qdot::bench {
namespace {

constexpr int turns = 7;

/// The largest over the columns of error over largest magnitude.
double relative(const std::vector<double>& errors, const std::vector<double>& scales) {
  double largest = 0;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    if (errors[k] > 0) largest = std::max(largest, errors[k] / scales[k]);
  }
  return largest;
}

/// Of each column.
std::vector<double> largest_of(const std::vector<double>& rows, std::size_t width) {
  std::vector<double> largest(width);
  for (std::size_t i = 0; i < rows.size(); ++i)
    largest[i % width] = std::max(largest[i % width], std::abs(rows[i]));
  return largest;
}

std::vector<double> difference(std::vector<double> rows, const std::vector<double>& reference) {
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] -= reference[i];
  return rows;
}

double time_of(const Problem& problem, const SimulationRequest& request, const AccuracyGoal& goal) {
  const double start = seconds();
  (void)simulate_with_error(problem.dynamics, request, goal);
  return seconds() - start;
}

}  // namespace

void write_presets(const Problem& problem, const std::vector<double>& reference, std::ostream& out) {
  const SimulationRequest request = problem.request();
  const std::size_t width = problem.y_start.size();
  const std::vector<double> scales = largest_of(reference, width);
  for (const auto& [name, value] : {std::pair{"fast", 1e-3}, {"balanced", 1e-6}, {"accurate", 1e-9}}) {
    AccuracyGoal goal;
    goal.kind = AccuracyGoal::Kind::relative;
    goal.value = value;
    std::vector<double> times;
    for (int turn = 0; turn < turns; ++turn) times.push_back(time_of(problem, request, goal));
    const MeasuredSimulation measured = simulate_with_error(problem.dynamics, request, goal);
    const std::vector<double> errors = largest_of(difference(measured.simulation.states, reference), width);
    out << problem.motion.name << ',' << name << ',' << 1e6 * median(times) << ',' << relative(errors, scales)
        << ',' << relative(measured.max_abs_error, scales) << ',' << measured.meets_request.value_or(false)
        << ',' << measured.evaluations << '\n';
  }
  out.flush();
}

void write_ladder(const Problem& problem, std::ostream& out) {
  SimulationRequest request = problem.request();
  for (const double rtol : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    request.tolerances = {rtol, rtol * 1e-3};
    AccuracyGoal goal;
    std::vector<double> alone, both;
    for (int turn = 0; turn < turns; ++turn) {
      for (const bool verify : {false, true}) {
        goal.verify = verify;
        (verify ? both : alone).push_back(time_of(problem, request, goal));
      }
    }
    const double first = median(alone);
    out << problem.motion.name << ',' << rtol << ',' << 1e6 * first << ',' << 1e6 * (median(both) - first)
        << '\n';
  }
  out.flush();
}

}  // namespace qdot::bench
