#include "tests/calibration/outcome.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "core/motion/dense_grid.hpp"
#include "tests/support/scenes.hpp"

namespace qdot::test {
namespace {

/// The reference vouches for a number that its two orders agree on to 25 digits, or, where the motion
/// amplifies every error, to a thousandth of the error that is judged by it; the quick one for those that
/// they agree on to a thousandth of the stated error.
constexpr double digits_of_reference = 1e-25;
constexpr double share_of_error = 1e-3;
constexpr double horizon_at = 1e-3;
constexpr double horizon_factor = 3;       ///< of errors that are stated too large
constexpr std::uint64_t quick_steps = 10;  ///< in the time of one

double cpu_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::vector<ColumnOutcome> empty_columns(const Asked& asked, const MeasuredSimulation& measured) {
  const Model& model = *model_of(asked.system);
  const std::size_t n = model.degrees_of_freedom();
  std::vector<ColumnOutcome> columns(2 * n);
  for (std::size_t k = 0; k < 2 * n; ++k) {
    columns[k].name = model.scene.coordinates[k % n].name + (k < n ? "" : "_dot");
    if (!measured.max_abs_error.empty()) columns[k].stated = measured.max_abs_error[k];
    for (std::size_t i = 0; i < measured.simulation.rows; ++i) {
      columns[k].scale = std::max(columns[k].scale, std::abs(measured.simulation.states[i * 2 * n + k]));
    }
  }
  return columns;
}

/// Whether an error that is stated truly cannot be a thousandth of what a column is at its rows.
bool has_no_horizon(const Outcome& outcome) {
  return !outcome.measured.horizon && std::ranges::all_of(outcome.columns, [](const ColumnOutcome& column) {
    return horizon_factor * column.stated <= horizon_at * column.scale;
  });
}

/// The largest that each column is along the motion, between its rows as well: what a horizon is judged by.
void take_sizes_along(const Asked& asked, const Dynamics& dynamics, Outcome& outcome) {
  for (ColumnOutcome& column : outcome.columns) column.size_along = column.scale;
  if (has_no_horizon(outcome)) return;
  SimulationRequest request = asked.request;
  request.grid = DenseGrid(request).t;
  request.grid_left_out.clear();
  request.tolerances = outcome.measured.tolerances;
  const Simulation motion = simulate(dynamics, request);
  const std::size_t width = outcome.columns.size();
  for (std::size_t i = 0; i < motion.rows * width; ++i) {
    double& size = outcome.columns[i % width].size_along;
    size = std::max(size, std::abs(motion.states[i]));
  }
}

bool vouches(const Reference<Quad>& reference, std::size_t place, const ColumnOutcome& column, double error) {
  return reference.doubt[place] <= std::max(digits_of_reference * column.scale, share_of_error * error);
}

bool vouches(const Reference<Long>& reference, std::size_t place, const ColumnOutcome& column, double) {
  return reference.doubt[place] <= share_of_error * column.stated;
}

/// Up to the first row that the reference does not vouch for.
template <typename Number>
void compare(const Asked& asked, const Reference<Number>& reference, Outcome& outcome) {
  const Simulation& motion = outcome.measured.simulation;
  const std::size_t width = asked.request.y_start.size();
  for (std::size_t i = 0; i < std::min(motion.rows, reference.motion.rows); ++i) {
    std::vector<double> error(width);
    for (std::size_t k = 0; k < width; ++k) {
      const std::size_t place = i * width + k;
      const Number difference = reference.value(place) - Number(motion.states[place]);
      error[k] = std::abs(static_cast<double>(difference));
      if (!vouches(reference, place, outcome.columns[k], error[k])) return;
    }
    outcome.known_rows = i + 1;
    for (std::size_t k = 0; k < width; ++k) {
      ColumnOutcome& column = outcome.columns[k];
      column.true_error = std::max(column.true_error, error[k]);
      const double useful = horizon_at * column.size_along, t = asked.request.grid[i];
      if (!outcome.earliest_horizon && horizon_factor * error[k] > useful) outcome.earliest_horizon = t;
      if (!outcome.true_horizon && error[k] > useful) outcome.true_horizon = t;
    }
  }
}

}  // namespace

bool Outcome::failed() const {
  const Ending ending = measured.simulation.ending;
  return !refusal.empty() || (ending != Ending::reached_end && ending != Ending::event);
}

std::string Outcome::status() const {
  if (!refusal.empty()) return "refused: " + refusal;
  constexpr const char* names[]{"complete",  "stopped", "step-limit",     "nonfinite",   "singular-mass",
                                "tolerance", "blow-up", "no-convergence", "undetermined"};
  const std::string name = names[static_cast<std::size_t>(measured.simulation.ending)];
  return measured.simulation.stop ? "stopped: " + measured.simulation.stop->reason : name;
}

Outcome outcome_of(const Asked& asked, std::uint64_t reference_steps) {
  Outcome outcome;
  const double begin = cpu_time();
  try {
    const Dynamics dynamics(model_of(asked.system), asked.inputs());
    outcome.measured = simulate_with_error(dynamics, asked.request, asked.goal);
    outcome.columns = empty_columns(asked, outcome.measured);
    take_sizes_along(asked, dynamics, outcome);
  } catch (const Error& error) {
    outcome.refusal = error.what();
    return outcome;
  }
  const double middle = cpu_time();
  outcome.cpu = middle - begin;
  if (outcome.failed() || outcome.measured.simulation.rows == 0) return outcome;
  QuadProblem problem = asked.problem();
  problem.grid.resize(outcome.measured.simulation.rows);
  const Outcome unknown = outcome;
  const Reference<Long> quick = quick_reference(problem, quick_steps * reference_steps);
  compare(asked, quick, outcome);
  if (outcome.known_rows < quick.motion.rows) {
    outcome = unknown;
    compare(asked, quad_reference(problem, reference_steps), outcome);
  }
  outcome.reference_cpu = cpu_time() - middle;
  return outcome;
}

}  // namespace qdot::test
