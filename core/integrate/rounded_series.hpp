#pragma once
// What rounding to doubles makes of the terms of a series whose high coefficients are doubles.
//
// The motion through y + d, with d as large as that rounding but enlarged, has other coefficients:
//
//   r_k = |c_k(y + d) - c_k(y)| / e,    |d_q| = 2^-53 e |q|,   |d_v| = e (2^-53 |v| + h a_r),
//
// with e up to 2^27, a_r what rounding to doubles does to each acceleration and h a step. It is so small that
// nothing is pushed farther in a step than it is from zero, or moves anyway; where that leaves hardly more
// than the rounding itself doubles tell nothing of the forces. Each component is moved to a side of its own,
// so that no direction in which motions part is left out but by chance: a sample, and no bound. Where low
// coefficients, which are known in both, are off by less, so are the others: a rest that doubles hold exactly
// stays one. Terms of y itself need not show any of it: beside a balance of forces they are as small as what
// is left of these, and rounding to doubles is all of it.

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

  /// Whether coefficients in doubles tell anything of a step h.
  [[nodiscard]] bool tells(double h) const { return !is_pushed_ || told_part(h) == h; }

  /// h, or as much of it as leaves terms in doubles small beside the others.
  [[nodiscard]] double told_part(double h) const;

  /// What coefficients in doubles are off by at the end of a step h of component i.
  [[nodiscard]] double off(std::size_t i, double h) const;

 private:
  void enlarge(std::span<const DoubleDouble> c, unsigned order, std::span<const double> of_forces, double h);
  void take_share(std::span<const DoubleDouble> c, unsigned order, double h);
  [[nodiscard]] double largest(std::size_t i, unsigned from, unsigned to, double h) const;

  const RightHandSide& in_doubles_;
  unsigned first_in_doubles_, order_;  ///< two coefficients in doubles tell what they make
  std::vector<double> y_, c_, own_;
  double enlarged_{};      ///< e
  bool is_pushed_{};       ///< by rounding alone as far as it moves
  double share_{1};        ///< of r_k, what rounding has made of the low coefficients
  std::vector<double> r_;  ///< width x order_, from k = 1 on
};

}  // namespace qdot
