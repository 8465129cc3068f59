#include "core/numerics/ball.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "core/numerics/constants.hpp"
#include "core/numerics/double_double_function.hpp"

namespace qdot {
namespace {

/// An operation is within 10 u^2 = 10 2^-106 of the exact result; sine and cosine within some 30 of that.
constexpr double unit = 0x1p-102;
constexpr double wave_unit = 0x1p-97;
/// Those of double_double_function.hpp are within 2e-31.
constexpr double function_unit = 0x1p-101;
/// Below this, the products inside an operation may underflow.
constexpr double smallest_exact = 1e-250;
/// Above this, they may overflow.
constexpr double largest_exact = 1e300;

/// Radii are added up in doubles that are rounded to nearest.
double slightly_above(double radius) { return radius * (1 + 0x1p-48); }

Ball rounded(const DoubleDouble& middle, double radius, double relative = unit) {
  const double size = std::abs(middle.high);
  if (!std::isfinite(size)) return {DoubleDouble{}, infinity};
  const double underflow = size < smallest_exact ? 1e-300 : 0;
  return {middle, slightly_above(radius + relative * size + underflow)};
}

constexpr std::size_t terms = 15;  // (pi/4)^31/31! < 2^-120

/// (-1)^k/(2k + offset)!
std::array<DoubleDouble, terms> alternating_inverse_factorials(int offset) {
  std::array<DoubleDouble, terms> result;
  DoubleDouble factor = 1;
  for (std::size_t k = 0; k < terms; ++k) {
    result[k] = factor;
    const double n = 2 * static_cast<double>(k) + offset;
    factor = factor / DoubleDouble(-(n + 1) * (n + 2));
  }
  return result;
}

DoubleDouble series(const std::array<DoubleDouble, terms>& coefficients, const DoubleDouble& square) {
  DoubleDouble sum;
  for (std::size_t k = terms; k-- > 0;) sum = sum * square + coefficients[k];
  return sum;
}

/// An angle as k pi/2 + rest, |rest| < 0.8, with a bound of the error of rest.
struct Reduced {
  long quarter;
  DoubleDouble rest;
  double error;
};
Reduced reduced(const DoubleDouble& x) {
  constexpr double half_pi[3]{1.5707963267948966, 6.123233995736766e-17, -1.4973849048591833e-33};
  const double k = std::nearbyint(x.high / half_pi[0]);
  DoubleDouble rest = x;
  double error = std::abs(k) * 1e-49;  // of the three doubles for pi/2, and of k times the last
  for (const double part : half_pi) {
    rest = rest - two_product(k, part);
    error += unit * std::abs(rest.high);
  }
  return {static_cast<long>(k), rest, k == 0 ? 0 : error};
}

/// sin(a + phase pi/2).
Ball sine_wave(const Ball& a, long phase) {
  static const std::array<DoubleDouble, terms> sine = alternating_inverse_factorials(1);
  static const std::array<DoubleDouble, terms> cosine = alternating_inverse_factorials(0);
  if (!a.is_finite() || a.magnitude() > largest_angle) {
    const Function function = phase == 0 ? Function::sin : Function::cos;
    return a.is_finite() ? Ball::of(evaluate(function, a.interval())) : Ball(DoubleDouble{}, infinity);
  }
  const Reduced angle = reduced(a.middle);
  const DoubleDouble square = angle.rest * angle.rest;
  const long quarter = angle.quarter + phase;
  const auto wave = [&](bool odd) {
    return odd ? series(cosine, square) : angle.rest * series(sine, square);
  };
  DoubleDouble value = wave(quarter % 2 != 0);
  if (((quarter % 4) + 4) % 4 >= 2) value = -value;
  if (a.is_zero() && value.high == 0) return {};
  double spread = 0;
  if (a.radius > 0) {  // |sin(m + e) - sin m| <= |cos m| |e| + e^2/2
    const double slope = std::abs(wave(quarter % 2 == 0).high) * (1 + 0x1p-50) + angle.error;
    spread = a.radius * std::min(1.0, slope + a.radius);
  }
  return rounded(value, spread + angle.error, wave_unit);
}

Ball whole_power(Ball base, unsigned exponent) {
  Ball result = 1;
  for (; exponent != 0; exponent >>= 1U) {
    if (exponent & 1U) result = result * base;
    if (exponent > 1) base = base * base;
  }
  return result;
}

/// |f'| on all of x, f being smooth there.
double steepest(Function function, const Interval& x) {
  switch (function) {
    case Function::tan:
      return (Interval(1) / square(cos(x))).upper;
    case Function::asin:
    case Function::acos:
      return (Interval(1) / sqrt(Interval(1) - square(x))).upper;
    case Function::sinh:
      return evaluate(Function::cosh, x).upper;
    case Function::cosh:
      return evaluate(Function::sinh, x).magnitude();
    case Function::exp:
      return evaluate(Function::exp, x).upper;
    case Function::log:
      return (Interval(1) / x).upper;
    case Function::sin:
    case Function::cos:
    case Function::atan:
    case Function::tanh:
    case Function::abs:
      return 1;
    case Function::sign:
      break;
  }
  return infinity;
}

}  // namespace

Ball Ball::literal(const Real& real) {
  if (!std::isfinite(real.value)) return {DoubleDouble{}, infinity};
  return {real.double_double(), real.error};
}

Ball Ball::of(const Interval& interval) {
  if (!interval.is_finite()) return {DoubleDouble{}, infinity};
  return {interval.middle(), interval.width() == 0 ? 0 : slightly_above(interval.radius())};
}

double Ball::error() const {
  const double left = std::abs((middle - DoubleDouble(value())).high);
  return slightly_above(left + radius);
}

Interval Ball::interval() const {
  const double left = error();
  if (left == 0) return value();
  return Interval(value()) + Interval(-left, left);
}

namespace {

bool is_double(const Ball& a) { return a.middle.low == 0 && a.radius == 0; }

/// 1 or -1, exactly.
bool is_unit(const Ball& a) { return std::abs(a.middle.high) == 1 && is_double(a); }

}  // namespace

/// Sums and products of two doubles have room in both parts.
Ball operator+(const Ball& a, const Ball& b) {
  if (a.is_zero()) return b;
  if (b.is_zero()) return a;
  const DoubleDouble sum = a.middle + b.middle;
  if (is_double(a) && is_double(b) && std::isfinite(sum.high)) return {sum, 0};
  if (sum.high == 0 && std::isfinite(a.middle.high)) return {sum, slightly_above(a.radius + b.radius)};
  return rounded(sum, a.radius + b.radius);
}

Ball operator-(const Ball& a) { return {-a.middle, a.radius}; }

Ball operator*(const Ball& a, const Ball& b) {
  if (a.is_zero() || b.is_zero()) return a.is_finite() && b.is_finite() ? Ball() : Ball({}, infinity);
  if (is_unit(a)) return a.middle.high < 0 ? -b : b;  // nothing is rounded
  if (is_unit(b)) return b.middle.high < 0 ? -a : a;
  const DoubleDouble product = a.middle * b.middle;
  const double size = std::abs(product.high);
  if (is_double(a) && is_double(b) && size >= smallest_exact && size < largest_exact) return {product, 0};
  const double radius = (std::abs(a.middle.high) + a.radius) * b.radius + std::abs(b.middle.high) * a.radius;
  return rounded(product, slightly_above(radius));
}

Ball operator/(const Ball& a, const Ball& b) {
  const double least = std::abs(b.middle.high) * (1 - 0x1p-50) - b.radius;
  if (!(least > 0)) return {DoubleDouble{}, infinity};
  if (a.is_zero()) return {};
  const DoubleDouble quotient = a.middle / b.middle;
  return rounded(quotient, slightly_above((a.radius + std::abs(quotient.high) * b.radius) / least));
}

Ball sqrt(const Ball& a) {
  if (a.is_zero()) return {};
  const double least = a.middle.high * (1 - 0x1p-50) - a.radius;
  if (!(least > 0)) return {DoubleDouble{}, infinity};
  return rounded(sqrt(a.middle), slightly_above(a.radius / std::sqrt(least)));
}

Ball sin(const Ball& a) { return sine_wave(a, 0); }
Ball cos(const Ball& a) { return sine_wave(a, 1); }

namespace {

/// a^c by twice the digits of doubles, for bases that are positive for certain.
Ball power_of_positive(const Ball& a, const Ball& exponent) {
  const Interval x = a.interval(), c = exponent.interval();
  const Interval log_x = evaluate(Function::log, x);
  const double by_base = a.radius == 0 ? 0 : a.radius * (c * power(x, c - Interval(1))).magnitude();
  const double by_exponent = exponent.radius == 0 ? 0 : exponent.radius * (log_x * power(x, c)).magnitude();
  const double relative = function_unit * (1 + (c * log_x).magnitude());
  const double spread = slightly_above(by_base + by_exponent);
  if (!std::isfinite(spread) || !std::isfinite(relative)) return Ball::of(power(x, c));
  return rounded(power(a.middle, exponent.middle), spread, slightly_above(relative));
}

}  // namespace

Ball power(const Ball& a, const Ball& exponent) {
  const double twice = 2 * exponent.middle.high;
  const bool exact = exponent.middle.low == 0 && exponent.radius == 0;
  if (!exact || twice != std::nearbyint(twice) || std::abs(twice) > 64) {
    if (!a.is_finite()) return a;
    const bool is_positive = a.interval().lower > 0;
    return is_positive ? power_of_positive(a, exponent) : Ball::of(power(a.interval(), exponent.interval()));
  }
  const auto halves = static_cast<unsigned>(std::abs(twice));
  Ball result = whole_power(a, halves / 2);
  if (halves % 2 != 0) result = result * sqrt(a);
  return twice < 0 ? Ball(1) / result : result;
}

Ball evaluate(Function function, const Ball& argument) {
  if (function == Function::sin) return sin(argument);
  if (function == Function::cos) return cos(argument);
  if (!argument.is_finite()) return argument;
  if (function == Function::sign) return Ball::of(evaluate(function, argument.interval()));
  const double spread = argument.radius == 0 ? 0 : argument.radius * steepest(function, argument.interval());
  const DoubleDouble value = evaluate(function, argument.middle);
  if (value.high == 0 && function != Function::exp && argument.middle.high == 0) return {value, spread};
  return std::isfinite(spread) ? rounded(value, slightly_above(spread), function_unit)
                               : Ball(DoubleDouble{}, infinity);
}

}  // namespace qdot
