// Intervals hold every value of what they are computed from; the second road is 64-bit arithmetic of the
// machine.

#include "core/numerics/interval.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random.hpp"

namespace qdot {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Of sizes from 1e-9 to 1e9 and both signs, or 0.
double some_number(test::Random& random) {
  if (random.integer(0, 20) == 0) return 0;
  return std::copysign(std::pow(10.0, random.real(-9, 9)), random.real(-1, 1));
}

Interval some_interval(test::Random& random) {
  const double a = some_number(random);
  if (random.integer(0, 3) == 0) return a;
  const double b = random.integer(0, 1) == 0 ? a * (1 + random.real(0, 1e-3)) : some_number(random);
  return {std::min(a, b), std::max(a, b)};
}

double member(const Interval& x, test::Random& random) {
  switch (random.integer(0, 3)) {
    case 0:
      return x.lower;
    case 1:
      return x.upper;
    default:
      return std::min(x.upper, x.lower + random.real() * x.width());
  }
}

bool holds(const Interval& interval, long double value) {
  return interval.lower <= value && value <= interval.upper;
}

/// Members of the operands, and what the operation makes of them, rounded ten bits finer.
template <class OfIntervals, class OfNumbers>
void expect_sound(std::uint64_t seed, const OfIntervals& of_intervals, const OfNumbers& of_numbers) {
  test::Random random(seed);
  for (int i = 0; i < 4000; ++i) {
    const Interval a = some_interval(random);
    const Interval b = some_interval(random);
    const Interval result = of_intervals(a, b);
    for (int k = 0; k < 5; ++k) {
      const double x = member(a, random);
      const double y = member(b, random);
      const long double value = of_numbers(static_cast<long double>(x), static_cast<long double>(y));
      if (!std::isfinite(value)) continue;
      ASSERT_TRUE(holds(result, value))
          << x << " " << y << " in [" << result.lower << ", " << result.upper << "]";
    }
  }
}

TEST(IntervalArithmetic, HoldsEverySumDifferenceProductAndQuotient) {
  expect_sound(
      1, [](auto a, auto b) { return a + b; }, [](auto x, auto y) { return x + y; });
  expect_sound(
      2, [](auto a, auto b) { return a - b; }, [](auto x, auto y) { return x - y; });
  expect_sound(
      3, [](auto a, auto b) { return a * b; }, [](auto x, auto y) { return x * y; });
  expect_sound(
      4, [](auto a, auto b) { return a / b; }, [](auto x, auto y) { return x / y; });
}

TEST(IntervalArithmetic, HoldsEverySquareRootAndPower) {
  expect_sound(
      5, [](auto a, auto) { return square(a); }, [](auto x, auto) { return x * x; });
  expect_sound(
      6, [](auto a, auto) { return sqrt(a); }, [](auto x, auto) { return std::sqrt(x); });
  for (const double exponent : {-3.0, -2.0, -1.0, 0.5, 1.5, 2.0, 3.0, 7.0, -0.5}) {
    expect_sound(
        7, [&](auto a, auto) { return power(a, exponent); },
        [&](auto x, auto) { return std::pow(x, static_cast<long double>(exponent)); });
  }
}

TEST(IntervalArithmetic, HoldsEveryValueOfEveryFunction) {
  using L = long double;
  const std::pair<Function, L (*)(L)> functions[] = {
      {Function::sin, [](L x) { return std::sin(x); }},   {Function::cos, [](L x) { return std::cos(x); }},
      {Function::tan, [](L x) { return std::tan(x); }},   {Function::asin, [](L x) { return std::asin(x); }},
      {Function::acos, [](L x) { return std::acos(x); }}, {Function::atan, [](L x) { return std::atan(x); }},
      {Function::sinh, [](L x) { return std::sinh(x); }}, {Function::cosh, [](L x) { return std::cosh(x); }},
      {Function::tanh, [](L x) { return std::tanh(x); }}, {Function::exp, [](L x) { return std::exp(x); }},
      {Function::log, [](L x) { return std::log(x); }},   {Function::abs, [](L x) { return std::abs(x); }}};
  std::uint64_t seed = 20;
  for (const auto& [function, value] : functions) {
    SCOPED_TRACE(static_cast<int>(function));
    expect_sound(
        seed++, [f = function](auto a, auto) { return evaluate(f, a); },
        [v = value](L x, L) { return v(x); });
  }
}

TEST(IntervalArithmetic, ExtremaOfSineAndCosineInsideCount) {
  test::Random random(40);
  for (int i = 0; i < 2000; ++i) {
    const double start = random.real(-30, 30) * (i % 2 == 0 ? 1 : std::pow(10, random.real(0, 12)));
    const Interval x{start, start + random.real(0, 7)};
    const Interval s = sin(x);
    const Interval c = cos(x);
    for (int k = 0; k <= 200; ++k) {
      const long double at = x.lower + static_cast<long double>(x.width()) * k / 200;
      if (at > x.upper) break;
      ASSERT_TRUE(holds(s, std::sin(at)) && holds(c, std::cos(at))) << x.lower << " " << x.upper;
    }
  }
}

TEST(IntervalArithmetic, IsNotWiderThanRoundingAsks) {
  test::Random random(50);
  for (int i = 0; i < 2000; ++i) {
    const double x = some_number(random);
    const double y = some_number(random);
    const Interval sum = Interval(x) + Interval(y);
    const Interval quotient = Interval(x) / Interval(y);
    EXPECT_LE(sum.width(), 8e-16 * std::abs(x + y) + 1e-320);
    if (y != 0) {
      EXPECT_LE(quotient.width(), 8e-16 * std::abs(x / y) + 1e-320);
    }
    EXPECT_LE(sin(Interval(random.real(-3, 3))).width(), 2e-15);
    EXPECT_LE(cos(Interval(random.real(-9e13, 9e13))).width(), 2e-15);
  }
}

TEST(IntervalArithmetic, WhatVanishesExactlyStaysZero) {
  const Interval zero(0);
  for (const Interval& x :
       {zero * Interval(3, 4), zero + zero, sin(zero), Interval(2) - Interval(2), square(zero)}) {
    EXPECT_EQ(x.lower, 0);
    EXPECT_EQ(x.upper, 0);
  }
}

TEST(IntervalArithmetic, PolesAndUndefinedPlacesAreTheWholeLine) {
  for (const Interval& x :
       {Interval(1) / Interval(-1, 1), Interval(1) / Interval(0), sqrt(Interval(-1, 2)),
        power(Interval(-1, 1), -2), power(Interval(-1, 1), 0.5), evaluate(Function::log, Interval(-1, 1)),
        evaluate(Function::asin, Interval(0, 2)), evaluate(Function::tan, Interval(1, 2))}) {
    EXPECT_EQ(x.lower, -infinity);
    EXPECT_EQ(x.upper, infinity);
  }
}

TEST(IntervalArithmetic, UnboundedOperandsAreUnderstood) {
  const Interval all = Interval::whole();
  EXPECT_EQ((Interval(0) * all).upper, infinity);             // it may have no value
  EXPECT_EQ((Interval(0) * Interval(1, infinity)).upper, 0);  // members are finite
  EXPECT_TRUE((all + Interval(1)).contains(1e300));
  EXPECT_EQ(sin(all).lower, -1);
  EXPECT_EQ(sin(all).upper, 1);
  EXPECT_TRUE(std::isfinite(all.middle()));
  EXPECT_TRUE((Interval(1e300) * Interval(1e300)).upper == infinity);
  EXPECT_FALSE((Interval(1e300) * Interval(1e300)).is_finite());
  EXPECT_TRUE((Interval(1e-300) * Interval(1e-300)).lower >= 0);
  EXPECT_GT((Interval(1e-300) * Interval(1e-300)).upper, 0);
}

}  // namespace
}  // namespace qdot
