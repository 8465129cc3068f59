#pragma once
// What the conservation of h leaves for the kinetic energy of one coordinate x:
//
//   F(x) = 1/2 A(x) x'^2 = h - U(x) = T0 - (x - x0) U[x0, x],   T0 = 1/2 A(x0) x0'^2 [J]
//
// enclosed, rounding included, with a few roundings of T0 and of U(x) - U(x0) themselves: the divided
// difference U[x0, x] never cancels (core/numerics/divided_difference.hpp). Motion needs F(x) >= 0.

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "core/compile/tape_evaluator.hpp"
#include "core/dynamics/statics.hpp"
#include "core/numerics/ball.hpp"
#include "core/numerics/divided_difference.hpp"
#include "core/numerics/taylor_enclosure.hpp"

namespace qdot {

/// F and A along a path x(s).
struct EnergySeries {
  FineSeries remaining, inertia;
};
struct CurvedEnergy {
  Curvature remaining, inertia;
};

class EnergyBalance {
 public:
  /// `statics` has one coordinate and a potential, and is quadratic in its velocity; it must outlive this.
  /// `constants`: the parameters and the momenta of the ignored coordinates. The motion starts at the numbers
  /// x0 and x0', which are next to doubles.
  EnergyBalance(const Statics& statics, std::span<const Ball> constants, const Real& x0, const Real& x0_dot);

  [[nodiscard]] double x0() const { return x0_.value; }
  [[nodiscard]] Interval start() const { return Interval::literal(x0_); }  ///< holds x0 itself
  /// Of the double x0() from the number x0.
  [[nodiscard]] double distance_from_start() const {
    return std::max(start().upper - x0_.value, x0_.value - start().lower);
  }
  [[nodiscard]] const Interval& kinetic_energy() const { return kinetic_energy_; }  ///< T0
  [[nodiscard]] Ball energy() const { return sharp_kinetic_ + sharp_start_; }       ///< h [J]
  [[nodiscard]] bool starts_at_rest() const { return at_rest_; }
  /// By how much h may change when x0 and x0' change by half a unit in their last place [J].
  [[nodiscard]] double rounding_of_start();

  [[nodiscard]] Interval remaining(const Interval& x);  ///< F(x)
  /// F(x) by arithmetic of twice the digits: slower, and sharper where U(x) - U(x0) is not small.
  [[nodiscard]] Interval remaining_sharply(double x);
  [[nodiscard]] Interval potential_rate_sharply(double x);  ///< g(x), in the same way
  [[nodiscard]] Interval potential_rate_at_start();         ///< at the number x0, in the same way
  /// U[a, x], U'(a) where they meet.
  [[nodiscard]] Interval potential_slope(const Interval& a, const Interval& x);
  [[nodiscard]] Interval potential(const Interval& x);  ///< U(x) [J]
  /// g(x) = U'(x); at a kink all slopes between those on its sides, so that the mean value theorem holds
  /// across it. The whole line where U jumps.
  [[nodiscard]] Interval potential_rate(const Interval& x);
  [[nodiscard]] Interval stiffness(const Interval& x);  ///< K(x) = U''(x); the whole line where U has a kink
  [[nodiscard]] Interval inertia(const Interval& x);    ///< A(x)
  [[nodiscard]] EnergySeries along(const FineSeries& x);
  [[nodiscard]] CurvedEnergy along(const Curvature& x);

 private:
  TapeEvaluator<DividedDifference> potential_;
  TapeEvaluator<Interval> rate_, stiffness_, inertia_;
  TapeEvaluator<Ball> sharp_potential_, sharp_rate_, sharp_inertia_;
  TapeEvaluator<Curvature> curved_potential_;
  std::optional<TapeEvaluator<Curvature>> curved_inertia_;
  std::optional<TapeEvaluator<FineSeries>> potential_series_, inertia_series_;  ///< made when asked for
  const Statics& statics_;
  std::vector<Ball> constants_;
  Ball sharp_start_, sharp_kinetic_;  ///< U(x0), T0
  Real x0_, x0_dot_;
  bool at_rest_;
  Interval kinetic_energy_;
};

}  // namespace qdot
