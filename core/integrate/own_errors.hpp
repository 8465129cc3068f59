#pragma once
// What a reference may be off by itself: two samples of it, for one alone may be small by chance, as where
// the errors of coordinates and velocities, or of parameters, cancel along what grows.
//
// Both follow e of separation.hpp. By truncation, from the motion as it is asked for: each step adds the
// bound of its defect, which goes with s^(order - 1) and comes to defect h/order, to the side where the other
// sample is, so that it adds up along what grows. So does what rounding makes of the accelerations, a bound e
// of core/compile/taylor/rounding.hpp that all computations have in common: e h of a velocity, e h^2/2 of its
// coordinate. By rounding, from a motion whose numbers differ by `enlarged` times as much as rounding makes:
// of whole last places two or three often cancel to nothing. Each step adds about half a last place of its
// largest term, enlarged as much, by random numbers. It adds the rounding of accelerations as well, always to
// the same side: in a short motion what goes to and fro with the other sample may cancel. Once it is large it
// would soon be as large as the motion and grow no more: what it stands for goes on with the other sample,
// and it begins anew.

#include "core/integrate/paired_rises.hpp"
#include "core/numerics/random_bits.hpp"

namespace qdot {

class OwnErrors {
 public:
  /// Apart::by_rounding over what rounding comes to.
  static constexpr double enlarged = 4096;

  /// Keeps references to the systems. `t` chooses the signs.
  OwnErrors(const Originals& originals, const Apart& start, double t);

  void follow(const MotionPiece& step);

  [[nodiscard]] Apart now() const {
    return {by_truncation_.now(), by_rounding_.now(), by_truncation_.reached(), share_of_rounding_};
  }
  /// The larger one at the two ends of the last step, of each component: of both together, and of rounding.
  [[nodiscard]] double in_last_step(std::size_t i) const {
    return by_truncation_.in_last_step()[i] + by_rounding_.in_last_step()[i] / enlarged;
  }
  [[nodiscard]] double rounding_in_last_step(std::size_t i) const {
    return by_rounding_.in_last_step()[i] / enlarged + share_of_rounding_ * by_truncation_.in_last_step()[i];
  }

 private:
  [[nodiscard]] bool is_rounding_large() const;
  void hand_over_rounding();
  void take_forces(const MotionPiece& step);

  Separation by_truncation_, by_rounding_;
  PairedRises rises_;
  RandomBits random_;
  double share_of_rounding_;    ///< in by_truncation_
  std::vector<double> always_;  ///< sides
  StepTerms terms_;
  std::vector<double> sizes_, signs_, of_forces_, of_series_, hidden_;  ///< scratch
};

}  // namespace qdot
