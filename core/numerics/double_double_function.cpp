#include "core/numerics/double_double_function.hpp"

#include <limits>
#include <span>

#include "core/numerics/double_double_tables.hpp"

namespace qdot {
namespace {

using tables::inverse_factorials;
using tables::inverse_factorials_rounded;

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// The sum of numbers that may cancel, to twice the digits of doubles: three sweeps leave four times those.
/// Source: Ogita, Rump, Oishi, Accurate sum and dot product, SIAM J. Sci. Comput. 26 (2005), algorithm 4.8.
DoubleDouble sum_of(std::span<double> terms) {
  for (int sweep = 0; sweep < 3; ++sweep) {
    for (std::size_t i = 1; i < terms.size(); ++i) {
      const DoubleDouble sum = two_sum(terms[i], terms[i - 1]);
      terms[i] = sum.high;
      terms[i - 1] = sum.low;
    }
  }
  DoubleDouble rest;
  for (std::size_t i = 0; i + 1 < terms.size(); ++i) rest = rest + DoubleDouble(terms[i]);
  return DoubleDouble(terms.back()) + rest;
}

/// a + b for |a| >= |b|, both of them far from cancelling.
DoubleDouble sum_of_large_and_small(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble sum = fast_two_sum(a.high, b.high);
  return fast_two_sum(sum.high, sum.low + (a.low + b.low));
}

/// x - m pi/16
DoubleDouble without_sixteenths(const DoubleDouble& x, double m) {
  const auto& part = tables::sixteenth_of_pi;
  if (std::abs(m) < 0x1p20) {
    DoubleDouble rest = x - two_product(m, part[0]);
    rest = rest - two_product(m, part[1]);
    rest = rest - DoubleDouble(m * part[2]);
    if (std::abs(rest.high) > 0x1p-30) return rest;  // all sums were as large as this
  }
  std::array<double, 10> terms;
  std::size_t i = terms.size();
  terms[--i] = x.high;
  terms[--i] = x.low;
  for (const double p : part) {
    const DoubleDouble product = two_product(-m, p);
    terms[--i] = product.high;
    terms[--i] = product.low;
  }
  return sum_of(terms);
}

/// |r| <= pi/32: the series, its last terms in doubles.
SineCosine near_zero(const DoubleDouble& r) {
  const DoubleDouble z = r * r;
  const auto& rounded = inverse_factorials_rounded;
  double tail = rounded[17];
  tail = rounded[15] - z.high * tail;
  tail = rounded[13] - z.high * tail;
  tail = rounded[11] - z.high * tail;
  DoubleDouble sine = tail;
  for (const std::size_t n : {9, 7, 5, 3}) sine = sum_of_large_and_small(inverse_factorials[n], -(z * sine));
  tail = rounded[18];
  for (const std::size_t n : {16, 14, 12, 10}) tail = rounded[n] - z.high * tail;
  DoubleDouble cosine = tail;
  for (const std::size_t n : {8, 6, 4, 2})
    cosine = sum_of_large_and_small(inverse_factorials[n], -(z * cosine));
  return {sum_of_large_and_small(r, -(r * (z * sine))), sum_of_large_and_small(1.0, -(z * cosine))};
}

/// 1 - sine and so on, a quarter turn further.
SineCosine turned(const SineCosine& s, int quarters) {
  switch (quarters & 3) {
    case 1:
      return {s.cosine, -s.sine};
    case 2:
      return {-s.sine, -s.cosine};
    case 3:
      return {-s.cosine, s.sine};
    default:
      return s;
  }
}

/// e^r - 1 for |r| <= ln(2)/64.
DoubleDouble exp_minus_one(const DoubleDouble& r) {
  double tail = 0;
  for (std::size_t n = 13; n >= 7; --n) tail = inverse_factorials_rounded[n] + r.high * tail;
  DoubleDouble sum = tail;
  for (std::size_t n = 6; n >= 2; --n) sum = sum_of_large_and_small(inverse_factorials[n], r * sum);
  return sum_of_large_and_small(r, r * (r * sum));
}

/// log x for x near 1: 2 artanh f, f = (x - 1)/(x + 1).
DoubleDouble log_near_one(const DoubleDouble& x) {
  const DoubleDouble f = (x - DoubleDouble(1)) / (x + DoubleDouble(1));
  const DoubleDouble z = f * f;
  double tail = 0;
  for (int n = 14; n >= 7; --n) tail = 1.0 / (2 * n + 1) + z.high * tail;
  DoubleDouble sum = tail;
  for (std::size_t n = 6; n >= 1; --n) sum = tables::inverse_odds[n] + z * sum;
  const DoubleDouble artanh = f + f * (z * sum);
  return artanh + artanh;
}

/// y + (x e^-y - 1) for a first approximation y; the next term is the square of the second's.
DoubleDouble log(const DoubleDouble& x) {
  if (!(x.high > 0)) return x.high == 0 ? -std::numeric_limits<double>::infinity() : no_value;
  if (!std::isfinite(x.high)) return x.high;
  int exponent{};
  double leading = std::frexp(x.high, &exponent);
  if (leading < 0.7) --exponent;
  const DoubleDouble m = scaled(x, -exponent);
  const DoubleDouble whole = tables::ln_2 * DoubleDouble(exponent);
  if (std::abs(m.high - 1) < 0.12) return whole + log_near_one(m);
  const DoubleDouble y = evaluate(Function::log, m.high);
  const DoubleDouble d = m * exp(-y) - DoubleDouble(1);
  return whole + (y + (d - DoubleDouble(d.high * d.high / 2)));
}

/// y + the angle left, whose tangent is (x cos y - sin y)/(x sin y + cos y).
DoubleDouble atan(const DoubleDouble& x) {
  constexpr double almost_infinite = 1e17;
  if (std::abs(x.high) > almost_infinite) {
    const DoubleDouble left = DoubleDouble(std::abs(1 / x.high));
    const DoubleDouble angle = tables::half_pi - left;
    return x.high < 0 ? -angle : angle;
  }
  const DoubleDouble y = evaluate(Function::atan, x.high);
  const SineCosine at = sine_cosine(y);
  return y + (x * at.cosine - at.sine) / (x * at.sine + at.cosine);
}

/// sqrt(1 - x^2)
DoubleDouble circle(const DoubleDouble& x) { return sqrt((DoubleDouble(1) - x) * (DoubleDouble(1) + x)); }

DoubleDouble asin(const DoubleDouble& x) {
  const DoubleDouble side = circle(x);
  if (side.high == 0) return x.high > 0 ? tables::half_pi : -tables::half_pi;
  return atan(x / side);
}

DoubleDouble acos(const DoubleDouble& x) {
  if (x.high > 0.5) return atan(circle(x) / x);
  return tables::half_pi - asin(x);
}

constexpr double series_until = 0.3;

/// e^-x beside e^x.
DoubleDouble falling(const DoubleDouble& growing) {
  constexpr double far_above = 1e40;
  return growing.high > far_above ? DoubleDouble() : DoubleDouble(1) / growing;
}

/// By its series where e^x - e^-x would cancel.
DoubleDouble sinh(const DoubleDouble& x) {
  if (std::abs(x.high) > series_until) {
    const DoubleDouble growing = exp(abs(x));
    const DoubleDouble value = (growing - falling(growing)) * DoubleDouble(0.5);
    return x.high < 0 ? -value : value;
  }
  const DoubleDouble z = x * x;
  double tail = 0;
  for (std::size_t n = 25; n >= 15; n -= 2) tail = inverse_factorials_rounded[n] + z.high * tail;
  DoubleDouble sum = tail;
  for (std::size_t n = 13; n >= 3; n -= 2) sum = inverse_factorials[n] + z * sum;
  return x + x * (z * sum);
}

DoubleDouble cosh(const DoubleDouble& x) {
  const DoubleDouble growing = exp(abs(x));
  return (growing + falling(growing)) * DoubleDouble(0.5);
}

DoubleDouble tanh(const DoubleDouble& x) {
  const DoubleDouble size = abs(x);
  if (size.high <= series_until) return sinh(x) / cosh(x);
  DoubleDouble value = 1;
  if (size.high < 100) value = value - DoubleDouble(2) / (exp(size + size) + DoubleDouble(1));
  return x.high < 0 ? -value : value;
}

}  // namespace

SineCosine sine_cosine(const DoubleDouble& x) {
  if (!(std::abs(x.high) < largest_angle)) return {no_value, no_value};
  constexpr double sixteenths_in_one = 5.092958178940651;  // 16/pi
  const double m = std::nearbyint(x.high * sixteenths_in_one);
  const double quarters = std::nearbyint(m / 8);
  const auto j = static_cast<int>(m - 8 * quarters);
  SineCosine s = near_zero(m == 0 ? x : without_sixteenths(x, m));
  if (j != 0) {
    const auto k = static_cast<std::size_t>(j < 0 ? -j : j);
    const DoubleDouble sine = j < 0 ? -tables::sines[k] : tables::sines[k];
    s = {sine * s.cosine + tables::cosines[k] * s.sine, tables::cosines[k] * s.cosine - sine * s.sine};
  }
  return turned(s, static_cast<int>(std::fmod(quarters, 4)));
}

DoubleDouble exp(const DoubleDouble& x) {
  if (std::isnan(x.high)) return no_value;
  if (x.high > 709.79) return std::numeric_limits<double>::infinity();
  if (x.high < -746) return 0.0;
  constexpr double parts_in_one = 46.16624130844683;  // 32/ln(2)
  const double m = std::nearbyint(x.high * parts_in_one);
  const auto& unit = tables::ln_2_over_32;
  DoubleDouble r = x - two_product(m, unit[0]);
  r = r - two_product(m, unit[1]);
  r = r - DoubleDouble(m * unit[2]);
  const auto whole = static_cast<int>(m);
  const DoubleDouble& root = tables::roots_of_two[static_cast<std::size_t>(whole & 31)];
  return scaled(root + root * exp_minus_one(r), whole >> 5);
}

DoubleDouble power(const DoubleDouble& x, const DoubleDouble& c) {
  if (c.high == 0) return 1.0;
  if (x.high == 0) return c.high > 0 ? 0.0 : std::numeric_limits<double>::infinity();
  const bool is_whole = std::nearbyint(c.high) == c.high && std::nearbyint(c.low) == c.low;
  if (x.high < 0 && !is_whole) return no_value;
  const DoubleDouble size = exp(c * log(abs(x)));
  const bool is_odd = std::fmod(c.high, 2) + std::fmod(c.low, 2) != 0;
  return x.high < 0 && is_odd ? -size : size;
}

DoubleDouble evaluate(Function function, const DoubleDouble& x) {
  switch (function) {
    case Function::sin:
      return sine_cosine(x).sine;
    case Function::cos:
      return sine_cosine(x).cosine;
    case Function::tan: {
      const SineCosine s = sine_cosine(x);
      return s.sine / s.cosine;
    }
    case Function::asin:
      return asin(x);
    case Function::acos:
      return acos(x);
    case Function::atan:
      return atan(x);
    case Function::sinh:
      return sinh(x);
    case Function::cosh:
      return cosh(x);
    case Function::tanh:
      return tanh(x);
    case Function::exp:
      return exp(x);
    case Function::log:
      return log(x);
    case Function::abs:
      return abs(x);
    case Function::sign:
      return std::isnan(x.high) ? x : static_cast<double>((x.high > 0) - (x.high < 0));
  }
  return x;  // not reached: the switch is complete
}

}  // namespace qdot
