#pragma once
// The one door through which every method evaluates y' = f(t, y): it counts, applies the limits, refuses what
// is not finite, and remembers why, so that a C library's failure code can be turned back into an Ending.

#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <span>

#include "core/integrate/run.hpp"

namespace qdot {

/// Answers have the values that SUNDIALS asks of its callbacks.
enum Answer : int {
  answer_ok = 0,
  answer_retry = 1,  ///< f has no value here: a smaller step may avoid the place
  answer_stop = -1   ///< a limit is spent or the caller has gone: give up
};

/// Calls are noexcept because C frames lie between them and the caller. What the user's function threw is
/// kept and thrown again by rethrow(). A Jacobian counts as one evaluation.
class Evaluator {
 public:
  /// Keeps references: both arguments must outlive it.
  Evaluator(const RightHandSide& system, const Limits& limits) : system_(system), limits_(limits) {}

  /// f(t, y), with f of y's size. Retry if y or f is not finite, |y_i| > max_magnitude, or M is singular.
  [[nodiscard]] Answer derivative(double t, std::span<const double> y, std::span<double> f) noexcept;

  /// df/dy, row-major n x n.
  [[nodiscard]] Answer jacobian(double t, std::span<const double> y, std::span<double> jacobian) noexcept;

  /// Why f last refused, since forget_trouble(); empty if it never did.
  /// A limit, once spent, is not forgotten.
  [[nodiscard]] std::optional<Ending> trouble() const { return trouble_; }
  void forget_trouble() {
    if (!stopped_) trouble_.reset();
  }

  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }
  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  using Function = std::function<Evaluation(double, std::span<const double>, std::span<double>)>;
  Answer evaluate(const Function& function, double t, std::span<const double> y,
                  std::span<double> out) noexcept;
  bool limits_allow_another();
  Answer refuse(Answer answer, Ending why);

  const RightHandSide& system_;
  const Limits& limits_;
  std::uint64_t evaluations_{};
  std::optional<Ending> trouble_;
  bool stopped_{false};
  std::exception_ptr exception_;
};

/// What is wrong with a state: nonfinite for NaN,
/// blow_up for an infinite component or one beyond max_magnitude.
[[nodiscard]] std::optional<Ending> unusable(std::span<const double> y, double max_magnitude);

/// Why f has no value; empty where it has one.
[[nodiscard]] constexpr std::optional<Ending> trouble_of(Evaluation evaluation) {
  switch (evaluation) {
    case Evaluation::ok:
      return std::nullopt;
    case Evaluation::singular_mass:
      return Ending::singular_mass;
    case Evaluation::nonfinite:
      break;
  }
  return Ending::nonfinite;
}

}  // namespace qdot
