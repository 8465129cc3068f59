#pragma once
// What rounding to doubles makes of the terms of a series whose high coefficients are doubles.
//
// The motion through y + d, with d as large as that rounding but enlarged, has other coefficients:
//
//   r_k = 2^-53 |c_k(y + d) - c_k(y)| / e,    |d_q| = e |q|,   |d_v| = e (|v| + min(h a_r / 2^-53, |q|/h)),
//
// with e = 2^-26, a_r what rounding to doubles does to each acceleration and h a step. What is pushed farther
// in a step than it is from zero is not followed: there doubles tell nothing of the forces. Each component is
// moved to a side of its own, so that no direction in which motions part is left out but by chance: a sample,
// and no bound. Where low coefficients, which are known in both, are off by less, so are the others: a rest
// that doubles hold exactly stays one. Terms of y itself need not show any of it: beside a balance of forces
// they are as small as what is left of these, and rounding to doubles is all of it.

#include <span>
#include <vector>

#include "core/integrate/run.hpp"
#include "core/numerics/double_double.hpp"

namespace qdot {

class RoundedSeries {
 public:
  /// Keeps a reference to the equations in doubles, which have an expansion.
  RoundedSeries(const RightHandSide& in_doubles, unsigned first_in_doubles);

  /// Of the coefficients y_i(t + s) = sum_k c[i (order + 1) + k] s^k, for steps up to h. `of_forces`: a_r,
  /// half as many as there are components.
  void take(double t, std::span<const DoubleDouble> c, unsigned order, std::span<const double> of_forces,
            double h);

  /// h, or as much of it as leaves terms in doubles small beside the others.
  [[nodiscard]] double told_part(double h) const;

  /// What coefficients in doubles are off by at the end of a step h of component i.
  [[nodiscard]] double off(std::size_t i, double h) const;

 private:
  void take_share(std::span<const DoubleDouble> c, unsigned order, double h);
  [[nodiscard]] double largest(std::size_t i, unsigned from, unsigned to, double h) const;

  const RightHandSide& in_doubles_;
  unsigned first_in_doubles_, order_;  ///< two coefficients in doubles tell what they make
  std::vector<double> y_, c_, own_;
  double share_{1};        ///< of r_k, what rounding has made of the low coefficients
  std::vector<double> r_;  ///< width x order_, from k = 1 on
};

}  // namespace qdot
