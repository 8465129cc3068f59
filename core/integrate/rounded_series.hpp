#pragma once
// How far rounding moves the terms of a series whose high coefficients are doubles.
//
// A motion that begins at y + d has other coefficients; d is the rounding of y to doubles, enlarged:
//
//   r_k = |c_k(y + d) - c_k(y)| / e,    |d_q| = 2^-53 e |q|,   |d_v| = e (2^-53 |v| + h a_r),
//
// with e up to 2^27, a_r the error of each acceleration by rounding, and h a step. e is so small that h^2 e
// a_r stays below |q| or h |v|. Where e would have to be below 16 for that, doubles know nothing of the
// forces. The signs of d are random: r_k is a sample, and no bound.
//
// The low coefficients are known in doubles and in double-doubles. Where these differ by less than r_k shows,
// all r_k are smaller by that share, so that a rest which doubles hold exactly stays a rest.
// The coefficients of y alone would not show this error: near a balance of forces they can be as small as it.

#include <span>
#include <vector>

#include "core/integrate/run.hpp"
#include "core/numerics/double_double.hpp"

namespace qdot {

class RoundedSeries {
 public:
  /// Keeps a reference to the equations in doubles, which have an expansion.
  RoundedSeries(const RightHandSide& in_doubles, unsigned first_in_doubles);

  /// Finds r_k for y_i(t + s) = sum_k c[i (order + 1) + k] s^k and steps up to h. `of_forces`: a_r, one for
  /// each velocity.
  void take(double t, std::span<const DoubleDouble> c, unsigned order, std::span<const double> of_forces,
            double h);

  /// Whether coefficients in doubles are of use for a step h.
  [[nodiscard]] bool tells(double h) const { return !is_pushed_ || told_part(h) == h; }

  /// The longest part of h for which the terms in doubles are small beside the others.
  [[nodiscard]] double told_part(double h) const;

  /// The error that the coefficients in doubles make of component i at the end of a step h.
  [[nodiscard]] double off(std::size_t i, double h) const;

 private:
  void enlarge(std::span<const DoubleDouble> c, unsigned order, std::span<const double> of_forces, double h);
  void take_share(std::span<const DoubleDouble> c, unsigned order, double h);
  [[nodiscard]] double largest(std::size_t i, unsigned from, unsigned to, double h) const;

  const RightHandSide& in_doubles_;
  unsigned first_in_doubles_, order_;  ///< r_k is found for two coefficients in doubles
  std::vector<double> y_, c_, own_;
  double enlarged_{};      ///< e
  bool is_pushed_{};       ///< rounding alone may move y as far as y moves
  double share_{1};        ///< of r_k, which the low coefficients show
  std::vector<double> r_;  ///< width x order_, from k = 1 on
};

}  // namespace qdot
