// Balls hold what they say, and are as narrow as twice the digits of doubles let them be.

#include "core/numerics/ball.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/random.hpp"

namespace qdot {
namespace {

/// Two balls around the same number overlap; narrow ones then agree.
void expect_same(const Ball& a, const Ball& b, double relative) {
  ASSERT_TRUE(a.is_finite() && b.is_finite());
  EXPECT_TRUE((a - b).contains_zero()) << a.value() << " " << b.value();
  EXPECT_LE(a.radius, relative * std::abs(a.value()));
}

TEST(Ball, FollowsTheLawsOfArithmetic) {
  test::Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Ball a = random.real(-3, 3), b = random.real(0.1, 3) * std::exp(random.real(-20, 20)),
               c = random.real(1, 2);
    expect_same((a + b) * c, a * c + b * c, 1e-15);
    expect_same(a / b * b, a, 1e-29);
    expect_same(square(sqrt(b)), b, 1e-29);
    expect_same((b + a) * (b - a), square(b) - square(a), 1e-3);
    expect_same(power(b, -1.5), Ball(1) / (b * sqrt(b)), 1e-28);
  }
}

TEST(Ball, HasPowersOfAnyExponentToTwiceTheDigits) {
  test::Random random(5);
  const Ball third = Ball(1) / Ball(3);
  for (int i = 0; i < 500; ++i) {
    const Ball a = random.real(0.1, 3) * std::exp(random.real(-20, 20)), c = random.real(-3, 3),
               d = random.real(-3, 3);
    const Ball root = power(a, third), wide = Ball(a.middle, 1e-9 * a.value());
    expect_same(root * root * root, a, 1e-27);
    expect_same(power(a, c) * power(a, d), power(a, c + d), 1e-27);
    EXPECT_LE((power(wide, c) - power(a, c)).magnitude(), 1e-8 * power(a, c).value());
    EXPECT_GE(power(wide, c).radius, 0.9e-9 * std::abs(c.value()) * power(a, c).value());
  }
  expect_same(power(Ball(-8), Ball(3)), Ball(-512), 1e-29);
  EXPECT_FALSE(power(Ball(-8), third).is_finite());
}

/// Bounds would make something of what cancels.
TEST(Ball, OfSumsAndProductsOfDoublesIsExact) {
  const Ball square = Ball(0.75) * Ball(0.75);
  EXPECT_TRUE((square * Ball(0.25) - Ball(0.5) * square / Ball(2)).contains_zero());
  EXPECT_TRUE((square * Ball(0.25) + Ball(-0.25) * square).is_zero());
  const Ball sum = Ball(0.1) + Ball(0.2), product = Ball(0.1) * Ball(0.2);
  EXPECT_EQ(sum.radius, 0);
  EXPECT_EQ(product.radius, 0);
  EXPECT_NE(sum.middle.low, 0);
  EXPECT_NE(product.middle.low, 0);
  EXPECT_GT((Ball(1e-200) * Ball(1e-200)).radius, 0);
  EXPECT_FALSE((Ball(1e200) * Ball(1e200)).is_finite());
}

TEST(Ball, KeepsTheSmallPartBesideTheLarge) {
  const Ball sum = Ball(0.7) + Ball(0.7e-14);
  expect_same(sum - Ball(0.7), Ball(0.7e-14), 1e-15);
  EXPECT_NE(sum.middle.low, 0);
}

TEST(Ball, HasTheSinesOfSumsAndOfLargeAngles) {
  test::Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const double reach = std::array{4.0, 9e5, 9e13}[static_cast<std::size_t>(i % 3)];
    const Ball a = random.real(-reach, reach), b = random.real(-4, 4);
    const Ball sum = sin(a) * cos(b) + cos(a) * sin(b);
    EXPECT_TRUE((sin(a + b) - sum).contains_zero());
    EXPECT_LE(sum.radius, 1e-24);
    EXPECT_LE((square(sin(a)) + square(cos(a)) - Ball(1)).magnitude(), 1e-24);
    EXPECT_NEAR(sin(b).value(), std::sin(b.value()), 1e-15);
    EXPECT_NEAR(cos(b).value(), std::cos(b.value()), 1e-15);
  }
  // pi - 3.141592653589793 to twice the digits: Abramowitz, Stegun, table 1.1.
  expect_same(sin(Ball(3.141592653589793)), Ball({1.2246467991473532e-16, -2.994769809718340e-33}, 1e-46),
              1e-14);
}

TEST(Ball, HasAllFunctionsToTwiceTheDigits) {
  test::Random random(6);
  for (int i = 0; i < 500; ++i) {
    const Ball a = random.real(-0.9, 0.9), b = random.real(-20, 20);
    expect_same(evaluate(Function::exp, a + b), evaluate(Function::exp, a) * evaluate(Function::exp, b),
                1e-27);
    expect_same(evaluate(Function::log, evaluate(Function::exp, b)), b, 1e-25);
    expect_same(evaluate(Function::tanh, b), evaluate(Function::sinh, b) / evaluate(Function::cosh, b),
                1e-27);
    expect_same(evaluate(Function::tan, a), sin(a) / cos(a), 1e-26);
    expect_same(sin(evaluate(Function::asin, a)), a, 1e-26);
    expect_same(cos(evaluate(Function::acos, a)), a, 1e-24);
    expect_same(evaluate(Function::tan, evaluate(Function::atan, b)), b, 1e-24);
  }
}

TEST(Ball, OfAFunctionHoldsItsValuesAtBothEnds) {
  test::Random random(7);
  for (std::size_t i = 0; i < function_names.size(); ++i) {
    const auto function = static_cast<Function>(i);
    for (int trial = 0; trial < 50; ++trial) {
      const double m = random.real(0.05, 0.9), r = std::ldexp(1.0, -random.integer(4, 40)) / 2;
      const Ball wide = evaluate(function, Ball({m, 0}, r));
      for (const double x : {m - r, m + r}) {
        const Ball narrow = evaluate(function, Ball(x));
        EXPECT_LE(std::abs((wide.middle - narrow.middle).high), wide.radius + narrow.radius)
            << name(function);
      }
    }
  }
  EXPECT_FALSE(evaluate(Function::log, Ball({0.5, 0}, 0.6)).is_finite());
  EXPECT_FALSE(evaluate(Function::asin, Ball({0.9, 0}, 0.2)).is_finite());
}

TEST(Ball, OfASineNearItsTopIsHardlySpread) {
  const Ball top = sin(Ball({1.5707963267948966, 0}, 1e-20));
  EXPECT_LT(top.radius, 1e-28);
  EXPECT_TRUE((top - Ball(1)).contains_zero());
  const Ball aside = sin(Ball({1, 0}, 1e-3));
  for (const double x : {1 - 1e-3, 1 + 1e-3})
    EXPECT_LE(std::abs((aside.middle - sin(Ball(x)).middle).high), aside.radius);
}

TEST(Ball, GrowsWithWhatIsNotKnown) {
  const Ball x({1.0, 0.0}, 1e-3);
  for (const double inside : {-1e-3, 0.0, 1e-3}) {
    const Ball point = 1 + inside;
    for (const auto& [wide, narrow] :
         {std::pair(sin(x), sin(point)), std::pair(x * x, point * point),
          std::pair(Ball(1) / x, Ball(1) / point), std::pair(sqrt(x), sqrt(point)),
          std::pair(evaluate(Function::exp, x), evaluate(Function::exp, point))}) {
      EXPECT_LE(std::abs(wide.value() - narrow.value()), wide.radius + narrow.radius + 1e-15);
    }
  }
  EXPECT_FALSE((Ball(1) / Ball({0.0, 0.0}, 1e-9)).is_finite());
  EXPECT_FALSE(sqrt(Ball(-1)).is_finite());
  EXPECT_TRUE((Ball(0) * x).is_zero());
}

}  // namespace
}  // namespace qdot
