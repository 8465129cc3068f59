#include "core/integrate/sundials_stepper.hpp"

#include <arkode/arkode.h>
#include <cvode/cvode.h>

#include <algorithm>
#include <new>

#include "core/integrate/initial_step.hpp"

namespace qdot {

static_assert(CV_MEM_FAIL == ARK_MEM_FAIL && CV_TOO_MUCH_ACC == ARK_TOO_MUCH_ACC);

SundialsStepper::SundialsStepper(const RightHandSide& system, const RunRequest& request, int first_order)
    : evaluator_(system, request.limits),
      request_(request),
      context_(make_context()),
      state_(make_vector(request.y_start, context_.get())),
      y_previous_(make_vector(request.y_start, context_.get())),
      t_previous_(request.t_start),
      t_(request.t_start),
      first_order_(first_order) {}

std::optional<Ending> SundialsStepper::step() {
  if (t_ != t_previous_) evaluator_.forget_trouble();
  if (const auto failed = choose_first_step()) return failed;
  std::ranges::copy(y(), elements(y_previous_.get()).begin());
  t_previous_ = t_;
  const int flag = advance();
  evaluator_.rethrow();
  if (flag < 0) {
    const Ending why = ending_of(flag);
    t_ = t_previous_;
    std::ranges::copy(elements(y_previous_.get()), elements(state_.get()).begin());
    return why;
  }
  ++steps_;
  return std::nullopt;
}

std::optional<Ending> SundialsStepper::choose_first_step() {
  if (steps_ > 0) return std::nullopt;
  const auto h = initial_step(evaluator_, t_, y(), request_.t_end, request_.tolerances, first_order_);
  evaluator_.rethrow();
  if (!h) return evaluator_.trouble();
  require_success(set_first_step(*h));
  return std::nullopt;
}

// The evaluator's own reason says more than a flag. What is left are attempts that all failed the error test
// or the corrector although f had values everywhere: no honest name but that the work led nowhere.
Ending SundialsStepper::ending_of(int flag) const {
  if (flag == CV_MEM_FAIL) throw std::bad_alloc();
  if (evaluator_.trouble()) return *evaluator_.trouble();
  return flag == CV_TOO_MUCH_ACC ? Ending::tolerance : Ending::step_limit;
}

bool SundialsStepper::copy_end(double t, std::span<double> y_out) const {
  if (t != t_ && t != t_previous_) return false;
  std::ranges::copy(elements(t == t_ ? state_.get() : y_previous_.get()), y_out.begin());
  return true;
}

}  // namespace qdot
