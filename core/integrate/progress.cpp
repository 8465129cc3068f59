#include "core/integrate/progress.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace qdot {
namespace {

constexpr std::uint64_t window = 1000;
constexpr double least_progress = 1e-9;  // of the span, in a window
constexpr double still_growing = 1.1;    // in half a window: behind a pulse nothing does

constexpr int most_still_steps = 10;
// Between a smooth motion, which moves by about the round-off of t in such a step (1e-13), and a singularity,
// where the step is a share of the time that is left (1e-3 to 1e-1).
constexpr double noticeable = 1e-6;

double distance(std::span<const double> a, std::span<const double> b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

double norm(std::span<const double> y) {
  double largest = 0;
  for (const double component : y) largest = std::max(largest, std::abs(component));
  return largest;
}

}  // namespace

// Nothing came before the first window, so that no growth in it is remarkable.
ProgressGuard::ProgressGuard(const RunRequest& request)
    : span_(request.t_end - request.t_start),
      window_start_(request.t_start),
      largest_(norm(request.y_start)),
      largest_before_window_(std::numeric_limits<double>::infinity()),
      y_when_moving_(request.y_start) {}

std::optional<Ending> ProgressGuard::check(const Stepper& stepper) {
  if (stepper.t() == stepper.t_previous()) return standing_still(stepper);
  still_steps_ = 0;
  const std::span<const double> y = stepper.y();
  for (std::size_t i = 0; i < y.size(); ++i) {
    y_when_moving_[i] = y[i];
    largest_ = std::max(largest_, std::abs(y[i]));
  }
  if (++window_steps_ == window / 2) largest_at_half_ = largest_;
  return window_steps_ < window ? std::nullopt : end_of_window(stepper.t());
}

std::optional<Ending> ProgressGuard::end_of_window(double t) {
  const bool stuck = t - window_start_ < least_progress * span_;
  const bool grows = largest_ > still_growing * largest_at_half_;
  const bool grown = grows && largest_ > 2 * largest_before_window_;
  window_start_ = t;
  window_steps_ = 0;
  largest_before_window_ = largest_;
  if (!stuck) return std::nullopt;
  return grown ? Ending::blow_up : Ending::step_limit;
}

std::optional<Ending> ProgressGuard::standing_still(const Stepper& stepper) {
  if (++still_steps_ < most_still_steps) return std::nullopt;
  if (const auto trouble = stepper.trouble()) return trouble;
  const bool singular = distance(stepper.y(), y_when_moving_) > noticeable * norm(y_when_moving_);
  return singular ? Ending::blow_up : Ending::tolerance;
}

}  // namespace qdot
