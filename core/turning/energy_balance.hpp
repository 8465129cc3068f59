#pragma once
// What the conservation of h leaves for the kinetic energy of one coordinate x:
//
//   F(x) = 1/2 A(x) x'^2 = h - U(x) = T0 - (x - x0) U[x0, x],   T0 = 1/2 A(x0) x0'^2 [J]
//
// enclosed, rounding included, with a few roundings of T0 and of U(x) - U(x0) themselves: the divided
// difference U[x0, x] never cancels (core/numerics/divided_difference.hpp). Motion needs F(x) >= 0.

#include <span>
#include <vector>

#include "core/compile/tape_evaluator.hpp"
#include "core/dynamics/statics.hpp"
#include "core/numerics/ball.hpp"
#include "core/numerics/divided_difference.hpp"

namespace qdot {

/// The doubles between which a ball lies.
[[nodiscard]] Interval interval_of(const Ball& ball);

class EnergyBalance {
 public:
  /// `statics` has one coordinate and a potential, and is quadratic in its velocity; it must outlive this.
  /// `constants`: the parameters and the momenta of the ignored coordinates. x0, x0' exact.
  EnergyBalance(const Statics& statics, std::span<const Ball> constants, double x0, double x0_dot);

  [[nodiscard]] double x0() const { return x0_; }
  [[nodiscard]] const Interval& kinetic_energy() const { return kinetic_energy_; }  ///< T0
  [[nodiscard]] bool starts_at_rest() const { return at_rest_; }

  [[nodiscard]] Interval remaining(const Interval& x);  ///< F(x)
  /// F(x) by arithmetic of twice the digits: dearer, and sharper where U(x) - U(x0) is not small.
  [[nodiscard]] Interval remaining_sharply(double x);
  /// U[a, x], U'(a) where they meet.
  [[nodiscard]] Interval potential_slope(const Interval& a, const Interval& x);
  [[nodiscard]] Interval potential(const Interval& x);       ///< U(x) [J]
  [[nodiscard]] Interval potential_rate(const Interval& x);  ///< g(x) = U'(x)
  [[nodiscard]] Interval stiffness(const Interval& x);       ///< K(x) = U''(x)
  [[nodiscard]] Interval inertia(const Interval& x);         ///< A(x)

 private:
  TapeEvaluator<DividedDifference> potential_;
  TapeEvaluator<Interval> rate_, stiffness_, inertia_;
  TapeEvaluator<Ball> sharp_potential_, sharp_inertia_;
  double x0_, x0_dot_;
  bool at_rest_;
  Interval kinetic_energy_;
};

}  // namespace qdot
