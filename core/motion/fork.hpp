#pragma once
// A place where a motion may do otherwise than its computations: where it comes as near to a kink, an impact
// or the end of its validity as its error is, or has met one and would have missed it with a small change
// within that error.
//
// g(t, y) is what vanishes there: the kink's argument, the distance of an impact, what must stay positive.
// The motion has y = (q, q'), 2n numbers in the scene's units, at the instant t at which g turns back, and
// component k may be off by e_k >= 0: the error that is stated for it before the place, with the rounding of
// y_k and of t. In all those states, by interval arithmetic, g differs from g(t, y) by at most
//
//   delta = max |g(t, z) - g(t, y)|   over   |z_k - y_k| <= e_k,
//
// and where that has no bound, delta is twice the first order, 2 R with R = sum_k |dg/dy_k| e_k. The other
// way turns back on the other side of g = 0, s = +1 or -1; it is open where -s g <= delta. It begins a little
// before the place, moved there, to first order, so that g reaches w where it turns:
//
//   y_k += lambda e_k sign(dg/dy_k),   lambda = (w - g)/R,   w = s max(delta, s g),
//
// so that |lambda| is about 2 at most. w is made larger where rounding would hide it. Whether a way is open
// rests on delta, which is as good as the e_k, and those are estimates; the slopes, by central differences,
// only aim.

#include <optional>
#include <vector>

#include "core/motion/event_comparison.hpp"

namespace qdot {

class Fork {
 public:
  /// Keeps references to both.
  Fork(const ComputedMotion& motion, const ApproachAsTold& approach);

  /// Whether the errors allow another way, at this place or at one of the others that it stands for.
  [[nodiscard]] bool is_open() const;
  /// Whether delta is a bound, and not the first order.
  [[nodiscard]] bool is_bounded() const { return is_bounded_; }
  /// A jump of forces that is over before it has moved the motion as far as it may be off anyway.
  [[nodiscard]] bool is_negligible() const;

  /// When the other way begins.
  [[nodiscard]] double begin() const;
  /// The state at `t`, which is begin(): 2n numbers. None where it is not before the event that it is to
  /// meet, or cannot be put on the constraints.
  [[nodiscard]] std::optional<std::vector<double>> start(double t) const;
  /// The state at the place itself, as fast towards the event as the errors allow: of bodies that have been
  /// beside each other since they met, so that no way begins before.
  [[nodiscard]] std::vector<double> at_place() const;

 private:
  [[nodiscard]] double value(double t, std::span<const double> y) const;
  [[nodiscard]] std::vector<double> state_at(double s) const;
  [[nodiscard]] double turned_by(double s) const;
  [[nodiscard]] double pull(std::span<const double> here, std::span<const double> beyond) const;
  void move_to_event();
  void take_slopes();
  [[nodiscard]] std::vector<Interval> within_errors() const;
  void take_doubt();
  [[nodiscard]] int side_of_way() const;
  [[nodiscard]] double wanted_value() const;
  [[nodiscard]] std::vector<double> on_way(std::vector<double> y) const;
  [[nodiscard]] std::vector<double> moved(std::vector<double> y, double g) const;

  const ComputedMotion& motion_;
  const ApproachRecord& approach_;
  const Approach& place_;
  const std::vector<double>& stated_;  ///< errors before it
  std::vector<double> beside_, y_, errors_;
  double t_;                ///< where g turns, or where the event is that a condition decides about
  double value_, doubt_{};  ///< g and delta
  bool is_bounded_{};
  std::vector<double> slopes_;  ///< of g in each component
  std::vector<double> rises_;   ///< of g by the error of each component
  double rise_{};               ///< by all
  double size_{};               ///< of the numbers that make up g
};

}  // namespace qdot
