#pragma once
// The error of a motion while its check still runs. Where it passes what is wanted in the first half, the
// rest of the check would only say by how much. The error at the end is then expected from how it has grown,
// over the time t since the motion began. From t_x/2 to t_x, where it was passed, it grew by 2^p:
//
//   x(t) ~ x(t_x) (t/t_x)^p           a frequency that is off by a constant makes p = 1, one that drifts p =
//   2; x(t) ~ x(t_x) 2^(2 p (t/t_x - 1)) from p = 3 on: it grows exponentially.

#include <span>
#include <vector>

#include "core/motion/motion_check.hpp"

namespace qdot {

class ErrorGrowth {
 public:
  /// `wanted`: the error of each column. Keeps a reference to the motion.
  ErrorGrowth(const ComputedMotion& motion, std::vector<double> wanted);

  /// The next rows of the check, from `first` of EventRows::instants() on; those at events do not count, and
  /// those before the first that is given are as the motion's. False where the rest is not worth while.
  [[nodiscard]] bool add(std::size_t first, std::span<const double> rows);

  /// The error at the motion's end in units of what is wanted.
  [[nodiscard]] double expected() const;

 private:
  [[nodiscard]] double time(std::size_t row) const;
  [[nodiscard]] double excess_of(std::size_t row, std::span<const double> other) const;

  const ComputedMotion& motion_;
  std::vector<double> wanted_;
  std::size_t seen_{};          ///< of the instants
  std::vector<double> excess_;  ///< x of each row of the motion: the largest up to there
};

}  // namespace qdot
