#include "core/integrate/extended_run.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/integrate/separation.hpp"
#include "core/integrate/step_terms.hpp"
#include "core/integrate/unit_of_time.hpp"
#include "core/numerics/function.hpp"

namespace qdot {
namespace {

constexpr int looks_in_step = 32;
constexpr int halvings_of_a_step = 110;  ///< of an interval: down to the last digit

double margin_of(const ExtendedSystem& system, const DoubleDouble& t, std::span<const DoubleDouble> y) {
  const double u = system.unit_of_time;
  if (u == 1) return system.margin(t, y);
  return system.margin(multiplied(t, u), with_velocities_multiplied(y, system.dimension, 1 / u));
}

/// Where in the last step the margin, negative at its end, is used up; none where it is nowhere positive.
std::optional<DoubleDouble> end_of_margin(const ExtendedSystem& system, const ExtendedStepper& stepper) {
  std::vector<DoubleDouble> y(system.dimension);
  const auto is_left = [&](const DoubleDouble& t) {
    stepper.interpolate(t, y);
    return margin_of(system, t, y) >= 0;
  };
  const DoubleDouble length = stepper.t() - stepper.t_previous();
  DoubleDouble last = stepper.t_previous(), beyond = stepper.t();
  int looks = 0;
  while (looks < looks_in_step && !is_left(last))
    last = stepper.t_previous() + length * DoubleDouble(1.0 * ++looks / looks_in_step);
  if (looks == looks_in_step) return std::nullopt;
  for (int i = 0; i < halvings_of_a_step; ++i) {
    const DoubleDouble middle = last + (beyond - last) * DoubleDouble(0.5);
    (is_left(middle) ? last : beyond) = middle;
  }
  return beyond;
}

class ExtendedIntegration {
 public:
  /// Keeps references to its arguments.
  ExtendedIntegration(const ExtendedSystem& system, const ExtendedRunRequest& request,
                      std::span<const DoubleDouble> grid)
      : system_(system),
        request_(request),
        grid_(grid),
        stepper_(system, request),
        passed_(system.dimension),
        terms_(system.dimension) {
    const bool is_full = system.first_in_doubles > request.order;
    std::vector<double> apart = request.apart;
    apart.resize(system.dimension);
    if (system.in_doubles.expansion)
      separation_.emplace(system.in_doubles, std::move(apart),
                          is_full ? Separation::Scale::by_largest : Separation::Scale::enlarged);
  }

  ExtendedRun run() {
    come_to(stepper_.t());
    while (run_.ending == Ending::reached_end && is_before(stepper_.t(), request_.t_end)) go_on();
    if (separation_) run_.apart_at_end = separation_->now();
    run_.steps = stepper_.steps();
    run_.bounded = stepper_.bounded();
    run_.evaluations = stepper_.evaluations();
    return std::move(run_);
  }

 private:
  void go_on() {
    if (const auto failed = stepper_.step()) {
      run_.ending = *failed;
      return;
    }
    if (separation_) follow_rounding();
    if (!system_.margin || margin_of(system_, stepper_.t(), stepper_.y()) >= 0) return come_to(stepper_.t());
    const auto end = end_of_margin(system_, stepper_);
    run_.ending = end ? Ending::event : Ending::undetermined;
    if (end) come_to(*end);
  }

  void follow_rounding() {
    const MotionPiece step = stepper_.polynomials();
    terms_.take(step);
    const std::span<const double> truncated = stepper_.truncated();
    separation_->follow(step, terms_,
                        {.sizes = truncated,
                         .sides = separation_->now(),
                         .of_series = truncated,
                         .acting = stepper_.rounded(),
                         .hidden = stepper_.hidden()});
  }

  /// With the rows up to there.
  void come_to(const DoubleDouble& t) {
    for (std::size_t k = 0; k < passed_.size(); ++k)
      passed_[k] = std::max(passed_[k], std::abs(stepper_.y()[k].high));
    for (; run_.rows < grid_.size() && !is_before(t, grid_[run_.rows]); ++run_.rows) {
      run_.passed.insert(run_.passed.end(), passed_.begin(), passed_.end());
      if (separation_) {
        const std::span<const double> apart = separation_->in_last_step();
        run_.apart.insert(run_.apart.end(), apart.begin(), apart.end());
      }
      const std::vector<DoubleDouble> row = state_at(grid_[run_.rows]);
      run_.states.insert(run_.states.end(), row.begin(), row.end());
    }
    run_.t = t;
    run_.y = state_at(t);
  }

  [[nodiscard]] std::vector<DoubleDouble> state_at(const DoubleDouble& t) const {
    std::vector<DoubleDouble> y(stepper_.y().begin(), stepper_.y().end());
    if (is_before(t, stepper_.t())) stepper_.interpolate(t, y);
    return y;
  }

  const ExtendedSystem& system_;
  const ExtendedRunRequest& request_;
  std::span<const DoubleDouble> grid_;
  ExtendedStepper stepper_;
  std::vector<double> passed_;
  StepTerms terms_;
  std::optional<Separation> separation_;
  ExtendedRun run_;
};

}  // namespace

ExtendedRun integrate(const ExtendedSystem& system, const ExtendedRunRequest& request,
                      std::span<const DoubleDouble> grid) {
  const double u = system.unit_of_time;
  if (u == 1) return ExtendedIntegration(system, request, grid).run();
  const std::size_t n = system.dimension;
  ExtendedRunRequest by_clock = request;
  by_clock.t_start = multiplied(request.t_start, 1 / u);
  by_clock.t_end = multiplied(request.t_end, 1 / u);
  multiply_velocities(std::span(by_clock.y_start), n, u);
  multiply_velocities(std::span(by_clock.apart), n, u);
  std::vector<DoubleDouble> grid_by_clock(grid.begin(), grid.end());
  for (DoubleDouble& t : grid_by_clock) t = multiplied(t, 1 / u);
  ExtendedRun run = ExtendedIntegration(system, by_clock, grid_by_clock).run();
  run.t = multiplied(run.t, u);
  multiply_velocities(std::span(run.states), n, 1 / u);
  multiply_velocities(std::span(run.y), n, 1 / u);
  for (std::vector<double>* const numbers : {&run.passed, &run.apart, &run.apart_at_end})
    multiply_velocities(std::span(*numbers), n, 1 / u);
  return run;
}

unsigned extended_order(double rtol, unsigned highest) {
  const double wanted = -evaluate(Function::log, rtol) / 2 + 1;
  return std::clamp(static_cast<unsigned>(wanted), std::min(12U, highest), highest);
}

}  // namespace qdot
