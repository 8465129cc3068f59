#pragma once
// Runs that go on without getting anywhere, and what to call them.

#include <cstdint>
#include <optional>
#include <vector>

#include "core/integrate/run.hpp"
#include "core/integrate/stepper.hpp"

namespace qdot {

/// Watches each step of a run. Two things end it.
///
/// 1000 steps that advance t by less than 1e-9 of the span. They are called step_limit (a sliding
/// discontinuity, or the far side of a narrow pulse), but blow_up if |y| meanwhile grew to twice its largest
/// value before them, and was growing to their end (a singularity approached at a tight tolerance).
///
/// 10 steps in a row so short that t + h = t. If f had no value at a place tried meanwhile, that is the
/// reason. Otherwise the state tells. If it moves noticeably while t stands still, it is no function of t any
/// more: a singularity (y' = y^2 at its pole, a fall into 1/r^2), which is called blow_up. If it does not
/// move, only the tolerances can want such steps, and the ending is called tolerance.
class ProgressGuard {
 public:
  explicit ProgressGuard(const RunRequest& request);

  /// Why the run should end after the stepper's last step; empty if it is getting on.
  [[nodiscard]] std::optional<Ending> check(const Stepper& stepper);

 private:
  std::optional<Ending> end_of_window(double t);
  std::optional<Ending> standing_still(const Stepper& stepper);

  double span_;
  double window_start_;
  std::uint64_t window_steps_{};
  double largest_;  ///< |y| up to now
  double largest_before_window_;
  double largest_at_half_{};           ///< of the window
  std::vector<double> y_when_moving_;  ///< the state when t last advanced
  int still_steps_{};
};

}  // namespace qdot
