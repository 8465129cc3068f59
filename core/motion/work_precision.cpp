#include "core/motion/work_precision.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/work_bounds.hpp"
#include "core/integrate/methods.hpp"

namespace qdot {
namespace {

constexpr std::uint64_t patience = 5;                  ///< evaluations of a trial over those of the reference
constexpr std::uint64_t most_evaluations = 3'000'000;  ///< of all trials together
constexpr double atol_over_rtol = 1e-3;
/// The last is for expansions alone: other methods ask for at least 1e-14.
constexpr std::array<double, 13> rtols{1e-3,  1e-4,  1e-5,  1e-6,  1e-7,  1e-8, 1e-9,
                                       1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15};

/// Of fixed length, over the mean step of the reference.
constexpr std::array<double, 8> fixed_steps{4, 2, 1, 0.5, 0.25, 0.125, 0.0625, 0.03125};

Tolerances in_proportion(double rtol) { return {rtol, rtol * atol_over_rtol}; }

double tightest_rtol(Method method) {
  return record_of(method).expands() ? rtols.back() : rtols[rtols.size() - 2];
}

std::uint64_t evaluations_of_trials(const Limits& limits) {
  if (work_bounds() == WorkBounds::none) return limits.max_evaluations;
  return std::min(limits.max_evaluations, most_evaluations);
}

bool succeeded(const TrialResult& trial) { return !trial.max_abs_error.empty(); }

}  // namespace

WorkPrecision::WorkPrecision(const Dynamics& dynamics, const SimulationRequest& request)
    : dynamics_(dynamics), request_(request), left_(evaluations_of_trials(request.limits)) {
  request_.columns.clear();
  request_.events.clear();
  request_.taylor_order = 0;
  request_.method = Method::taylor;
  request_.tolerances = in_proportion(tightest_rtol(request_.method));
  reference_ = simulate_with_error(dynamics_, request_, {});
}

std::vector<Trial> WorkPrecision::trials(Method method) const {
  if (method == Method::taylor && reference_.simulation.method != Method::taylor) return {};
  std::vector<Trial> result;
  if (record_of(method).has_fixed_step()) {
    const double h = (request_.t_end - request_.t_start) / static_cast<double>(reference_.simulation.steps);
    for (const double share : fixed_steps) result.push_back({method, {}, share * h});
    return result;
  }
  for (const double rtol : rtols) {
    if (rtol >= tightest_rtol(method)) result.push_back({method, in_proportion(rtol), 0});
  }
  return result;
}

SimulationRequest WorkPrecision::request_of(const Trial& trial, std::uint64_t evaluations) const {
  SimulationRequest request = request_;
  request.method = trial.method;
  request.tolerances = trial.tolerances;
  request.h = trial.h;
  request.limits.max_evaluations = evaluations;
  return request;
}

void WorkPrecision::repeat(const TrialResult& trial) const {
  (void)simulate(dynamics_, request_of(trial.trial, trial.evaluations));
}

TrialResult WorkPrecision::run(const Trial& trial) {
  const Simulation& exact = reference_.simulation;
  const std::uint64_t most = std::min(left_, patience * exact.evaluations);
  const Simulation found = simulate(dynamics_, request_of(trial, most));
  left_ -= std::min(left_, found.evaluations);
  TrialResult result{trial, found.ending, {}, 0, found.evaluations, found.steps};
  if (!ended_well(found.ending) || reference_.max_abs_error.empty()) return result;
  const std::size_t width = request_.y_start.size();
  result.max_abs_error = reference_.max_abs_error;
  for (std::size_t k = 0; k < width; ++k) {
    double difference = 0;
    for (std::size_t i = 0; i < std::min(found.rows, exact.rows); ++i) {
      difference = std::max(difference, std::abs(found.states[i * width + k] - exact.states[i * width + k]));
    }
    result.max_abs_error[k] += difference;
    result.error = std::max(result.error, result.max_abs_error[k]);
  }
  return result;
}

std::vector<bool> pareto_front(std::span<const TrialResult> trials, std::span<const double> costs) {
  const auto beats = [&](std::size_t i, std::size_t j) {
    const double better = trials[i].error, worse = trials[j].error;
    return succeeded(trials[i]) &&
           ((better <= worse && costs[i] < costs[j]) || (better < worse && costs[i] <= costs[j]));
  };
  std::vector<bool> result(trials.size());
  for (std::size_t j = 0; j < trials.size(); ++j) {
    result[j] = succeeded(trials[j]);
    for (std::size_t i = 0; i < trials.size() && result[j]; ++i) result[j] = !beats(i, j);
  }
  return result;
}

std::optional<std::size_t> cheapest(std::span<const TrialResult> trials, std::span<const double> costs,
                                    double wanted) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (!succeeded(trials[i]) || trials[i].error > wanted) continue;
    if (!best || costs[i] < costs[*best]) best = i;
  }
  return best;
}

}  // namespace qdot
