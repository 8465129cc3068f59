// Intervals by logarithms hold what they should, and keep signs where doubles end.

#include "core/numerics/log_interval.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random.hpp"

namespace qdot {
namespace {

LogInterval number(double x) { return LogInterval(Interval(x)); }

TEST(LogIntervals, HoldTheResultsOfArithmeticOnNumbersInThem) {
  test::Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const double a = random.real(-5, 5), b = random.real(-5, 5);
    const Interval sum = (number(a) + number(b)).interval();
    const Interval product = (number(a) * number(b)).interval();
    const Interval quotient = (number(a) / number(b)).interval();
    EXPECT_TRUE(sum.lower <= a + b && a + b <= sum.upper) << a << " " << b;
    EXPECT_LT(sum.width(), 1e-11);  // some units of 2^-46
    EXPECT_TRUE(product.contains(a * b));
    EXPECT_TRUE(quotient.contains(a / b));
    EXPECT_TRUE(square(number(a)).interval().contains(a * a));
    EXPECT_TRUE(power(number(a), 3).interval().contains(a * a * a));
    EXPECT_TRUE(evaluate(Function::sinh, number(a)).interval().contains(std::sinh(a)));
    EXPECT_TRUE(evaluate(Function::cosh, number(a)).interval().contains(std::cosh(a)));
  }
}

TEST(LogIntervals, OfWideOperandsHoldAllPairs) {
  test::Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const double a = random.real(-5, 5), b = random.real(-5, 5), s = random.real(0, 1), t = random.real(0, 1);
    const double wa = random.real(0, 3), wb = random.real(0, 3);
    const LogInterval x(Interval(a, a + wa)), y(Interval(b, b + wb));
    const double u = a + s * wa, v = b + t * wb;
    EXPECT_TRUE((x + y).interval().contains(u + v));
    EXPECT_TRUE((x * y).interval().contains(u * v));
    EXPECT_TRUE((x + -y).interval().contains(u - v));
    EXPECT_TRUE(square(x).interval().contains(u * u));
  }
}

TEST(LogIntervals, KnowTheSignOfWhatUnderflowsOrOverflows) {
  const LogInterval far(Interval(800, 1e15));
  const LogInterval falling = evaluate(Function::exp, -far);
  EXPECT_FALSE(falling.contains_zero());
  const LogInterval nearer = evaluate(Function::exp, -LogInterval(Interval(800, 1500)));
  EXPECT_FALSE((nearer + -square(nearer)).contains_zero()) << "exp(-1500) exceeds exp(-800)^2";
  const LogInterval rising = evaluate(Function::exp, far);
  EXPECT_FALSE((rising * (number(1) + -rising) + number(3)).contains_zero());
  EXPECT_FALSE(evaluate(Function::exp, -square(far)).contains_zero());
  EXPECT_TRUE((falling + -falling).contains_zero());
}

TEST(LogIntervals, ClaimNothingWhereNumbersCancel) {
  const LogInterval x(Interval(1e10, 1.0000001e10));
  EXPECT_TRUE((evaluate(Function::exp, x) + -evaluate(Function::exp, x)).contains_zero());
  EXPECT_TRUE((number(1) / LogInterval(Interval(-1, 1))).contains_zero());
}

}  // namespace
}  // namespace qdot
