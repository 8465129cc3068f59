#include "core/motion/ladder.hpp"

#include <stdexcept>

#include "core/integrate/methods.hpp"
#include "core/motion/accuracy_reasons.hpp"
#include "core/motion/measurement.hpp"

namespace qdot {
namespace {

using Kind = AccuracyGoal::Kind;
using GivesUp = Measurement::GivesUp;

constexpr int most_rungs = 8;

class Ladder {
 public:
  Ladder(const Dynamics& dynamics, const SimulationRequest& request, const AccuracyGoal& goal)
      : goal_(goal), measurement_(dynamics, request, goal) {}

  /// One run with the tolerances of the request.
  MeasuredSimulation stay(const Tolerances& tolerances) {
    measurement_.take(tolerances);
    if (goal_.verify && ended_well(now().simulation.ending)) measurement_.measure(GivesUp::never);
    return finished(std::move(now()));
  }

  MeasuredSimulation climb() {
    Tolerances next = first_tolerances(goal_);
    std::optional<Tolerances> given_up;
    for (int i = 0; i < most_rungs; ++i) {
      measurement_.take(next);
      if (!ended_well(now().simulation.ending)) break;
      const bool may_give_up = goal_.is_error() && i + 1 < most_rungs;
      measurement_.measure(may_give_up ? GivesUp::where_it_pays : GivesUp::never);
      if (measurement_.expected_excess()) {
        given_up = next;
        excess_ = *measurement_.expected_excess();
        next = tighter_tolerances(next, excess_);
        continue;
      }
      if (keep_best() || now().max_abs_error.empty()) break;
      const double too_large = measurement_.resolve_columns();
      if (next.rtol <= tightest_tolerance && too_large == 1) break;
      excess_ /= too_large;
      const auto wanted = tighter(next);
      if (!wanted) break;
      next = *wanted;
    }
    if (!best_ && given_up) measure_to_the_end(*given_up);
    return finished(std::move(best_ ? *best_ : now()));
  }

 private:
  /// The last run.
  [[nodiscard]] MeasuredSimulation& now() { return measurement_.result(); }

  /// What was given up is the best there is.
  void measure_to_the_end(const Tolerances& tolerances) {
    measurement_.take(tolerances);
    if (!ended_well(now().simulation.ending)) return;
    measurement_.measure(GivesUp::never);
    (void)keep_best();
  }

  /// True when the goal is met.
  bool keep_best() {
    if (now().max_abs_error.empty()) return false;
    if (goal_.kind == Kind::work) {
      best_ = now();
      return false;
    }
    const double excess = measurement_.excess();
    now().meets_request = now().bounded && excess <= 1 && !measurement_.contradicts();
    excess_ = excess;
    if (!best_ || best_contradicts_ || (excess < best_excess_ && !measurement_.contradicts())) {
      best_ = now();
      best_excess_ = excess;
      best_contradicts_ = measurement_.contradicts();
    }
    return excess <= 1 && !measurement_.contradicts();
  }

  /// None when there is no work left for them.
  [[nodiscard]] std::optional<Tolerances> tighter(const Tolerances& now) const {
    if (goal_.kind != Kind::work) return tighter_tolerances(now, excess_);
    return tolerances_for_work(now, best_->simulation.evaluations, measurement_.left());
  }

  MeasuredSimulation finished(MeasuredSimulation result) {
    measurement_.thin(result.simulation);
    result.evaluations = measurement_.spent();
    if (goal_.is_error() && result.max_abs_error.empty()) {
      result.meets_request = false;  // for the reason that there is already
    } else if (result.meets_request == false && result.reason.empty()) {
      result.reason = why_not_met(result);
    }
    return result;
  }

  [[nodiscard]] const char* why_not_met(const MeasuredSimulation& result) const {
    if (!result.bounded) return accuracy_reasons::not_bounded;
    const bool may_be_tighter = result.tolerances.rtol > tightest_tolerance;
    const bool work_is_spent = may_be_tighter && measurement_.left() < result.simulation.evaluations;
    return measurement_.has_doubt() || work_is_spent ? accuracy_reasons::work_spent
                                                     : accuracy_reasons::out_of_reach;
  }

  const AccuracyGoal& goal_;
  Measurement measurement_;
  std::optional<MeasuredSimulation> best_;
  double best_excess_{}, excess_{};
  bool best_contradicts_{false};
};

}  // namespace

MeasuredSimulation simulate_with_error(const Dynamics& dynamics, const SimulationRequest& request,
                                       const AccuracyGoal& goal) {
  if (record_of(request.method).has_fixed_step() && goal.kind != Kind::tolerances) {
    throw std::invalid_argument("a method of fixed step has no goal");
  }
  Ladder ladder(dynamics, request, goal);
  return goal.kind == Kind::tolerances ? ladder.stay(request.tolerances) : ladder.climb();
}

}  // namespace qdot
