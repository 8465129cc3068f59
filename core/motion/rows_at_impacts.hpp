#pragma once
// Rows at an impact. Two computations of a motion meet it at instants t_k and s_k that differ by their
// errors, and a row in between is before it in one and after it in the other: its state differs by the whole
// impact, however near they are to each other. Such a row is compared on the side of the motion,
//
//   y_other(t) = y_side(s_k) + (t - s_k) y'_side,
//
// with the state and the slopes of the other one on that side, as long as the motion goes on by less than a
// thousandth of each column in between.

#include <optional>
#include <span>
#include <vector>

#include "core/motion/motion_check.hpp"

namespace qdot {

class RowsAtImpacts {
 public:
  /// `scale`: of each column. Keeps references.
  RowsAtImpacts(const ComputedMotion& motion, std::span<const double> scale);

  /// The other's state at the row's instant t on the motion's side of an impact; none where both are on the
  /// same, or where they are too far apart.
  [[nodiscard]] std::optional<std::vector<double>> on_side_of_motion(const Simulation& other, double t);

 private:
  [[nodiscard]] std::optional<std::vector<double>> slopes(double t, std::span<const double> y);
  [[nodiscard]] bool is_short(double duration, std::span<const double> slopes) const;

  const ComputedMotion& motion_;
  std::span<const double> scale_;
  Workspace workspace_;
};

}  // namespace qdot
