#pragma once
// Ball arithmetic: a number known to lie within `radius` of `middle`, which has twice the digits of a double.
// Every operation encloses its results, rounding included, so what is computed from exact doubles comes out
// with some 1e-31 of its size, and with a bound that is rigorous. For TapeEvaluator.
// Source: van der Hoeven, Ball arithmetic (2009); Johansson, Arb: efficient arbitrary-precision
// midpoint-radius interval arithmetic, IEEE Trans. Comput. 66 (2017).

#include <algorithm>
#include <cmath>

#include "core/numerics/double_double.hpp"
#include "core/numerics/function.hpp"
#include "core/numerics/interval.hpp"

namespace qdot {

struct Ball {
  DoubleDouble middle;
  double radius{};  ///< not finite where there is no value

  Ball() = default;
  Ball(double value) : middle(value) {}  // implicit: a number is a ball
  Ball(const DoubleDouble& middle_value, double radius_bound) : middle(middle_value), radius(radius_bound) {}
  /// A real number with twice the digits of a double.
  [[nodiscard]] static Ball literal(const Real& value);
  [[nodiscard]] static Ball of(const Interval& interval);

  [[nodiscard]] double value() const { return middle.value(); }
  [[nodiscard]] bool contains_zero() const { return !(std::abs(middle.high) * (1 - 0x1p-50) > radius); }
  [[nodiscard]] bool is_zero() const { return middle.high == 0 && radius == 0; }
  [[nodiscard]] bool is_finite() const { return std::isfinite(middle.high) && std::isfinite(radius); }
  /// Largest absolute value, from above.
  [[nodiscard]] double magnitude() const { return (std::abs(middle.high) + radius) * (1 + 0x1p-50); }
  /// Bound of |x - value()| for every x in the ball.
  [[nodiscard]] double error() const;
  /// The doubles between which it lies.
  [[nodiscard]] Interval interval() const;
  [[nodiscard]] Real real() const { return {middle.high, middle.low, radius}; }
};

[[nodiscard]] Ball operator+(const Ball& a, const Ball& b);
[[nodiscard]] Ball operator-(const Ball& a);
[[nodiscard]] inline Ball operator-(const Ball& a, const Ball& b) { return a + -b; }
[[nodiscard]] Ball operator*(const Ball& a, const Ball& b);
[[nodiscard]] Ball operator/(const Ball& a, const Ball& b);

/// a 2^exponent, which rounds nothing as long as nothing underflows.
[[nodiscard]] inline Ball scaled(const Ball& a, int exponent) {
  return {{std::ldexp(a.middle.high, exponent), std::ldexp(a.middle.low, exponent)},
          std::ldexp(a.radius, exponent)};
}
/// k where 2^k is about |a|; 0 where that is 0.
[[nodiscard]] inline int size_of(const Ball& a) {
  const double size = std::abs(a.middle.high);
  return size > 0 ? std::clamp(std::ilogb(size), -1000, 1000) : 0;
}

[[nodiscard]] inline Ball square(const Ball& a) { return a * a; }
[[nodiscard]] Ball sqrt(const Ball& a);
[[nodiscard]] Ball sin(const Ball& a);
[[nodiscard]] Ball cos(const Ball& a);
[[nodiscard]] Ball power(const Ball& a, const Ball& exponent);
[[nodiscard]] Ball evaluate(Function function, const Ball& argument);

}  // namespace qdot
