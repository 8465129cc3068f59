#pragma once
// A place where a motion may do otherwise than its computations: where it comes as near to a kink, an impact
// or the end of its validity as its error is, or has met one and would, but for its error, have missed it.
// The other way begins a little before that place, moved within about twice the error to the side that takes
// it there:
//
//   y_k += lambda e_k sign(dg/dy_k),   g + lambda sum_k |dg/dy_k| e_k = -+ delta,
//
// with g where the motion turns, and delta what it may be off by in all states within e, by interval
// arithmetic.

#include <optional>
#include <vector>

#include "core/motion/event_comparison.hpp"

namespace qdot {

class Fork {
 public:
  /// Keeps references to both.
  Fork(const ComputedMotion& motion, const ApproachAsTold& approach);

  /// Whether the errors allow another way, there or where others are that it stands for.
  [[nodiscard]] bool is_open() const;
  /// Whether what its function may be there has a bound.
  [[nodiscard]] bool is_bounded() const { return is_bounded_; }
  /// A jump of forces that is over before it has moved the motion as far as it may be off anyway.
  [[nodiscard]] bool is_negligible() const;

  /// When the other way begins.
  [[nodiscard]] double begin() const;
  /// The state there; none where it is not before the event that it is to meet, or not a state at all.
  [[nodiscard]] std::optional<std::vector<double>> start(double t) const;

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
