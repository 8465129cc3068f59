#include "core/numerics/interval.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/numerics/constants.hpp"
#include "core/numerics/double_double_function.hpp"

namespace qdot {
namespace {

constexpr double largest = std::numeric_limits<double>::max();
/// SLEEF's functions are within one unit in the last place of the true value.
constexpr int units_of_functions = 2;

/// The neighbouring doubles: those of one sign are in the order of their bits.
double below(double x) {
  if (!(x > -infinity)) return x;
  if (x == 0) return -std::numeric_limits<double>::denorm_min();
  const auto bits = std::bit_cast<std::int64_t>(x);
  return std::bit_cast<double>(x > 0 ? bits - 1 : bits + 1);
}
double above(double x) { return -below(-x); }

/// The ends are rounded values of exact ones.
/// What is exactly zero stays so: products and sums that vanish do.
Interval outward(double lower, double upper) {
  if (std::isnan(lower) || std::isnan(upper)) return Interval::whole();
  return {lower == 0 ? lower : below(lower), upper == 0 ? upper : above(upper)};
}

Interval outward(Interval x, int units) {
  if (std::isnan(x.lower) || std::isnan(x.upper)) return Interval::whole();
  // SLEEF's exp, sinh and cosh become infinite a little before their values do: beyond 709.
  x.lower = std::min(x.lower, 0x1p1020);
  x.upper = std::max(x.upper, -0x1p1020);
  for (int i = 0; i < units; ++i) x = {below(x.lower), above(x.upper)};
  return x;
}

/// Underflow leaves the sign and the fact that the value is not zero.
double not_zero(double rounded) {
  return rounded == 0 ? std::copysign(std::numeric_limits<double>::denorm_min(), rounded) : rounded;
}

/// What may have no value: 0 times it has none either.
bool is_whole(const Interval& a) { return a.lower == -infinity && a.upper == infinity; }

/// 0 times infinity is 0: an unbounded interval has only finite members.
double product(double a, double b) { return a == 0 || b == 0 ? 0 : not_zero(a * b); }
double quotient(double a, double b) { return a == 0 ? 0 : not_zero(a / b); }

Interval range_of(const double (&ends)[4]) {
  double least = ends[0];
  double most = ends[0];
  for (const double end : ends) {
    if (std::isnan(end)) return Interval::whole();
    least = std::min(least, end);
    most = std::max(most, end);
  }
  return outward(least, most);
}

Interval increasing(Function function, const Interval& a) {
  return outward({evaluate(function, a.lower), evaluate(function, a.upper)}, units_of_functions);
}

/// Whether some k pi/2 with k = phase (mod 4) may lie in a, as far as turns are known when rounded.
bool reaches_quarter(const Interval& a, int phase) {
  const double slack = 1e-9 + 8 * std::numeric_limits<double>::epsilon() * a.magnitude();
  const double first = std::ceil(((a.lower - slack) / (pi / 2) - phase) / 4);
  return (4 * first + phase) * (pi / 2) <= a.upper + slack;
}

Interval wave(Function function, const Interval& a, int top, int bottom) {
  if (!a.is_finite() || a.magnitude() > largest_angle || a.width() >= 2 * pi) return {-1, 1};
  const double left = evaluate(function, a.lower);
  const double right = a.width() == 0 ? left : evaluate(function, a.upper);
  Interval range = outward({std::min(left, right), std::max(left, right)}, units_of_functions);
  if (a.lower == 0 && a.upper == 0) return left;  // exact: 0 or 1
  if (a.width() == 0) return intersection(range, {-1, 1});
  if (reaches_quarter(a, top)) range.upper = 1;
  if (reaches_quarter(a, bottom)) range.lower = -1;
  return intersection(range, {-1, 1});
}

Interval even(Function function, const Interval& a) {
  const double least = evaluate(function, a.least_magnitude());
  const double most = evaluate(function, a.magnitude());
  return outward({least, most}, units_of_functions);
}

Interval absolute(const Interval& a) { return {a.least_magnitude(), a.magnitude()}; }

Interval whole_power(const Interval& a, int exponent) {
  if (exponent < 0) return Interval(1) / whole_power(a, -exponent);
  Interval result(1);
  Interval factor = a;
  for (int e = exponent; e > 0; e /= 2) {
    if (e % 2 == 1) result = result * factor;
    factor = square(factor);
  }
  return result;
}

}  // namespace

Interval Interval::literal(const Real& real) {
  if (std::isinf(real.value))
    return real.value > 0 ? Interval(largest, infinity) : Interval(-infinity, -largest);
  if (real.is_exact()) return real.value;
  // Beyond a neighbour only where `value` is not the nearest double.
  const auto reached = [](double value, double beyond) {
    if (beyond <= 0) return value;
    const double next = above(value);
    return beyond <= next - value ? next : above(value + beyond);
  };
  return {-reached(-real.value, above(real.error - real.low)),
          reached(real.value, above(real.low + real.error))};
}

bool Interval::is_finite() const { return std::isfinite(lower) && std::isfinite(upper); }

double Interval::middle() const {
  const double a = std::max(lower, -largest);
  const double b = std::min(upper, largest);
  return a / 2 + b / 2;
}

double Interval::radius() const { return std::max(upper - middle(), middle() - lower); }

double Interval::magnitude() const { return std::max(std::abs(lower), std::abs(upper)); }

double Interval::least_magnitude() const {
  return contains(0.0) ? 0 : std::min(std::abs(lower), std::abs(upper));
}

Interval operator+(const Interval& a, const Interval& b) {
  return outward(a.lower + b.lower, a.upper + b.upper);
}
Interval operator-(const Interval& a, const Interval& b) {
  return outward(a.lower - b.upper, a.upper - b.lower);
}
Interval operator-(const Interval& a) { return {-a.upper, -a.lower}; }

Interval operator*(const Interval& a, const Interval& b) {
  const double p = a.lower * b.lower, q = a.lower * b.upper, r = a.upper * b.lower, s = a.upper * b.upper;
  const double least = std::min(std::min(p, q), std::min(r, s));
  const double most = std::max(std::max(p, q), std::max(r, s));
  if (std::isfinite((p + q) + (r + s)) && least != 0 && most != 0) return {below(least), above(most)};
  if (is_whole(a) || is_whole(b)) return Interval::whole();
  return range_of({product(a.lower, b.lower), product(a.lower, b.upper), product(a.upper, b.lower),
                   product(a.upper, b.upper)});
}

Interval operator/(const Interval& a, const Interval& b) {
  if (!(b.lower > 0 || b.upper < 0)) return Interval::whole();
  return range_of({quotient(a.lower, b.lower), quotient(a.lower, b.upper), quotient(a.upper, b.lower),
                   quotient(a.upper, b.upper)});
}

Interval square(const Interval& a) {
  const Interval magnitude = absolute(a);
  Interval result = magnitude * magnitude;
  result.lower = std::max(result.lower, 0.0);
  return result;
}

Interval sqrt(const Interval& a) {
  if (!(a.lower >= 0)) return Interval::whole();
  Interval root = outward(std::sqrt(a.lower), std::sqrt(a.upper));
  root.lower = std::max(root.lower, 0.0);
  return root;
}

Interval sin(const Interval& a) { return wave(Function::sin, a, 1, 3); }
Interval cos(const Interval& a) { return wave(Function::cos, a, 0, 2); }

Interval power(const Interval& a, const Interval& exponent) {
  const double n = exponent.lower;
  if (n == exponent.upper && n == std::nearbyint(n) && std::abs(n) <= 1024) {
    return whole_power(a, static_cast<int>(n));
  }
  if (!(a.lower >= 0)) return Interval::whole();
  if (a.lower == 0) {  // exp(y log x) has no value at 0
    if (!(exponent.lower > 0)) return Interval::whole();
    const Interval top = a.upper == 0 ? Interval(0) : power(Interval(a.upper), exponent);
    return {0, top.upper};
  }
  return evaluate(Function::exp, exponent * evaluate(Function::log, a));
}

Interval evaluate(Function function, const Interval& a) {
  switch (function) {
    case Function::sin:
      return sin(a);
    case Function::cos:
      return cos(a);
    case Function::tan:
      return sin(a) / cos(a);
    case Function::cosh:
      return even(function, a);
    case Function::abs:
      return absolute(a);
    case Function::sign:
      return {evaluate(function, a.lower), evaluate(function, a.upper)};
    case Function::acos:
      return -increasing(Function::asin, a) + Interval(below(pi / 2), above(pi / 2));
    case Function::asin:
    case Function::log:  // undefined outside their domains: NaN becomes the whole line
    case Function::atan:
    case Function::sinh:
    case Function::tanh:
    case Function::exp:
      break;
  }
  return increasing(function, a);
}

Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.lower, b.lower), std::max(a.upper, b.upper)};
}

Interval intersection(const Interval& a, const Interval& b) {
  return {std::max(a.lower, b.lower), std::min(a.upper, b.upper)};
}

}  // namespace qdot
