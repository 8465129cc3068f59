#pragma once
// What the steppers that SUNDIALS drives have in common: the state, where the last step began, f behind the
// library's callback, and what its failures mean.

#include "core/integrate/evaluator.hpp"
#include "core/integrate/stepper.hpp"
#include "core/integrate/sundials_handles.hpp"

namespace qdot {

class SundialsStepper : public Stepper {
 public:
  [[nodiscard]] std::optional<Ending> step() final;
  [[nodiscard]] double t_previous() const final { return t_previous_; }
  [[nodiscard]] double t() const final { return t_; }
  [[nodiscard]] std::span<const double> y() const final { return elements(state_.get()); }
  [[nodiscard]] std::optional<Ending> trouble() const final { return evaluator_.trouble(); }
  [[nodiscard]] std::uint64_t steps() const final { return steps_; }
  [[nodiscard]] std::uint64_t evaluations() const final { return evaluator_.evaluations(); }

 protected:
  /// Attempts at one step. The library's defaults (7 and 10) give up while the step could still shrink: near
  /// the edge of where f exists, or at a jump of f. A quarter each time, 30 of them reach the round-off of t.
  static constexpr int most_attempts = 30;

  /// `first_order`: of the error of the first step. Keeps both references.
  SundialsStepper(const RightHandSide& system, const RunRequest& request, int first_order);

  /// Both return the library's flag. advance() steps from state_ at t_ to the new ones.
  [[nodiscard]] virtual int set_first_step(double h) = 0;
  [[nodiscard]] virtual int advance() = 0;

  /// The library's callback; its user data are the evaluator.
  static int derivative(double t, N_Vector y, N_Vector f, void* evaluator) {
    return static_cast<Evaluator*>(evaluator)->derivative(t, elements(y), elements(f));
  }

  /// The state at one end of the last step; false for a time inside of it.
  [[nodiscard]] bool copy_end(double t, std::span<double> y_out) const;

  Evaluator evaluator_;
  const RunRequest& request_;
  ContextPointer context_;
  VectorPointer state_;
  VectorPointer y_previous_;
  double t_previous_;
  double t_;

 private:
  std::optional<Ending> choose_first_step();
  [[nodiscard]] Ending ending_of(int flag) const;

  int first_order_;
  std::uint64_t steps_{};
};

}  // namespace qdot
