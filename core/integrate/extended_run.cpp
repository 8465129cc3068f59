#include "core/integrate/extended_run.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/integrate/separation.hpp"
#include "core/integrate/step_terms.hpp"
#include "core/numerics/function.hpp"

namespace qdot {

ExtendedRun integrate(const ExtendedSystem& system, const ExtendedRunRequest& request,
                      std::span<const DoubleDouble> grid) {
  ExtendedStepper stepper(system, request);
  ExtendedRun run;
  const std::size_t n = request.y_start.size();
  std::vector<double> passed(n);
  StepTerms terms(n);
  std::optional<Separation> separation;
  const bool is_full = system.first_in_doubles > request.order;
  if (system.in_doubles.expansion)
    separation.emplace(system.in_doubles, std::vector<double>(n),
                       is_full ? Separation::Scale::by_largest : Separation::Scale::enlarged);
  const auto sample = [&] {
    for (std::size_t k = 0; k < n; ++k) passed[k] = std::max(passed[k], std::abs(stepper.y()[k].high));
    for (; run.rows < grid.size() && !is_before(stepper.t(), grid[run.rows]); ++run.rows) {
      run.states.resize((run.rows + 1) * n);
      run.passed.insert(run.passed.end(), passed.begin(), passed.end());
      if (separation) {
        const std::span<const double> apart = separation->in_last_step();
        run.apart.insert(run.apart.end(), apart.begin(), apart.end());
      }
      const auto row = std::span(run.states).last(n);
      if (stepper.steps() == 0) {
        std::ranges::copy(stepper.y(), row.begin());
      } else {
        stepper.interpolate(grid[run.rows], row);
      }
    }
  };
  sample();
  while (run.ending == Ending::reached_end && is_before(stepper.t(), request.t_end)) {
    const auto failed = stepper.step();
    if (failed) run.ending = *failed;
    if (!failed && separation) {
      const MotionPiece step = stepper.polynomials();
      terms.take(step);
      const std::span<const double> truncated = stepper.truncated();
      separation->follow(step, terms,
                         {.sizes = truncated,
                          .sides = separation->now(),
                          .of_series = truncated,
                          .hidden = stepper.hidden()});
      separation->add(stepper.rounded(), separation->now());
    }
    sample();
  }
  run.t = stepper.t();
  run.y.assign(stepper.y().begin(), stepper.y().end());
  run.steps = stepper.steps();
  run.bounded = stepper.bounded();
  run.evaluations = stepper.evaluations();
  return run;
}

unsigned extended_order(double rtol, unsigned highest) {
  const double wanted = -evaluate(Function::log, rtol) / 2 + 1;
  return std::clamp(static_cast<unsigned>(wanted), std::min(12U, highest), highest);
}

}  // namespace qdot
