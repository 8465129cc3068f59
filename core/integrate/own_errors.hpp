#pragma once
// Two samples of the error of a reference. One alone may be small by chance: errors of coordinates,
// velocities and parameters may cancel along the direction that grows.
//
// Each sample is an e of separation.hpp, and every step of length h adds to it, component by component:
//
//   truncation:  d_i = defect_i h/order   (a defect grows as s^(order - 1)),
//   forces:      r h for a velocity and r h^2/2 for its coordinate (r: core/compile/taylor/rounding.hpp),
//   rounding:    about half a last place of the step's largest term, with a random sign.
//
// The sample by_truncation begins at the motion that was asked for. It adds truncation and forces, with the
// signs of the other sample, so that errors add up along the direction that grows.
// The sample by_rounding begins at the rounded numbers. It adds rounding and forces. All of this is
// `enlarged`, for of whole last places two or three often cancel. Its forces keep their signs, for in a short
// motion alternating ones may cancel. When this sample becomes large, it is added to the other one and begins
// anew.

#include "core/integrate/paired_rises.hpp"
#include "core/numerics/random_bits.hpp"

namespace qdot {

class OwnErrors {
 public:
  /// Apart::by_rounding over the error that rounding makes.
  static constexpr double enlarged = 4096;

  /// Keeps references to the systems. `t` chooses the signs.
  OwnErrors(const Originals& originals, const Apart& start, double t);

  void follow(const MotionPiece& step);

  [[nodiscard]] Apart now() const {
    return {by_truncation_.now(), by_rounding_.now(), by_truncation_.reached(), share_of_rounding_};
  }
  /// For a component, the larger error at the two ends of the last step: in all, and by rounding.
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
  double share_of_rounding_;    ///< of by_truncation_
  std::vector<double> always_;  ///< signs of forces
  StepTerms terms_;
  std::vector<double> sizes_, signs_, of_forces_, of_series_, hidden_;  ///< scratch
};

}  // namespace qdot
