// Arithmetic and functions in twice the digits of doubles, against libquadmath's 113 bits.

#include "core/numerics/double_double.hpp"

#include <gtest/gtest.h>
#include <quadmath.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/numerics/double_double_function.hpp"
#include "core/numerics/double_double_system.hpp"
#include "tests/support/random.hpp"

namespace qdot {
namespace {

using Quad = __float128;

constexpr double tries = 3000;

Quad quad(const DoubleDouble& x) { return static_cast<Quad>(x.high) + x.low; }

/// 106 bits, so that a quad holds it.
DoubleDouble random_near(test::Random& random, double high) {
  const double last = std::ldexp(std::nearbyint(random.real(-0x1p51, 0x1p51)), std::ilogb(high) - 105);
  return fast_two_sum(high, last);
}

DoubleDouble random_between(test::Random& random, double from, double to) {
  return random_near(random, random.real(from, to));
}

double relative_error(const DoubleDouble& value, Quad exact) {
  if (exact == 0) return std::abs(value.high);
  return static_cast<double>(fabsq((quad(value) - exact) / exact));
}

TEST(DoubleDouble, AddsMultipliesDividesAndTakesRootsAsItsBoundsSay) {
  test::Random random(1);
  constexpr double u2 = 0x1p-106;
  for (int i = 0; i < tries; ++i) {
    const double scale = std::ldexp(1.0, static_cast<int>(random.real(-200, 200)));
    const DoubleDouble a = random_between(random, -3, 3), b = random_between(random, 0.1, scale);
    EXPECT_LE(relative_error(a * b, quad(a) * quad(b)), 5 * u2 + 1e-34);
    EXPECT_LE(relative_error(a / b, quad(a) / quad(b)), 15 * u2);
    EXPECT_LE(relative_error(sqrt(b), sqrtq(quad(b))), 5 * u2);
    const DoubleDouble near = random_near(random, a.high * (1 + random.real(-1e-9, 1e-9)));
    EXPECT_LE(relative_error(a - near, quad(a) - quad(near)), 3 * u2 + 1e-34);
  }
}

TEST(DoubleDouble, FindsTheRoundingOfAProductWithoutFusedMultiplyAdd) {
  test::Random random(2);
  for (int i = 0; i < tries; ++i) {
    const double a = std::ldexp(random.real(-2, 2), static_cast<int>(random.real(-400, 400)));
    const double b = std::ldexp(random.real(-2, 2), static_cast<int>(random.real(-400, 400)));
    const DoubleDouble product = two_product(a, b);
    const double error = std::abs(product.high) < least_product ? 0.0 : std::fma(a, b, -product.high);
    EXPECT_EQ(product.low, error) << a << " " << b;
  }
  const DoubleDouble large = two_product(1.5e300, 1.0 / 3);
  EXPECT_EQ(large.low, std::fma(1.5e300, 1.0 / 3, -large.high));
}

struct Case {
  Function function;
  Quad (*exact)(Quad);
  double from, to;
  double error{2e-31};
};

class Elementary : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    Functions, Elementary,
    testing::Values(Case{Function::sin, sinq, -20, 20}, Case{Function::sin, sinq, -1e13, 1e13},
                    Case{Function::cos, cosq, -20, 20}, Case{Function::cos, cosq, -1e13, 1e13},
                    Case{Function::tan, tanq, -20, 20}, Case{Function::asin, asinq, -1, 1},
                    Case{Function::acos, acosq, -1, 1}, Case{Function::acos, acosq, 0.999999, 1},
                    Case{Function::atan, atanq, -5, 5}, Case{Function::atan, atanq, -1e20, 1e20},
                    Case{Function::sinh, sinhq, -2, 2}, Case{Function::sinh, sinhq, -700, 700},
                    Case{Function::cosh, coshq, -700, 700}, Case{Function::tanh, tanhq, -2, 2},
                    Case{Function::tanh, tanhq, -60, 60}, Case{Function::exp, expq, -600, 700},
                    Case{Function::log, logq, 0, 2, 4e-31}, Case{Function::log, logq, 0.999, 1.001},
                    Case{Function::log, logq, 0, 1e290}, Case{Function::sin, sinq, -1e-9, 1e-9},
                    Case{Function::tanh, tanhq, -1e-9, 1e-9}, Case{Function::atan, atanq, -1e-9, 1e-9}));

TEST_P(Elementary, IsRightToThirtyDigits) {
  const Case& c = GetParam();
  test::Random random(3);
  for (int i = 0; i < tries; ++i) {
    const DoubleDouble x = random_between(random, c.from, c.to);
    const Quad exact = c.exact(quad(x));
    ASSERT_LE(relative_error(evaluate(c.function, x), exact), c.error)
        << name(c.function) << " " << x.high << " " << x.low;
  }
}

TEST(ElementaryFunctions, AreRightNextToTheZerosOfSineAndCosine) {
  // sin(m pi + e) = +-e for the pi that two doubles hold: its next 50 digits are what is left.
  constexpr double next_of_pi = -2.994769809718340e-33;
  for (int m = 1; m <= 1024; m *= 2) {
    const DoubleDouble x = pi_double_double * DoubleDouble(m);
    EXPECT_NEAR(evaluate(Function::sin, x).high / ((m == 1 ? -1 : 1) * next_of_pi * m), -1, 1e-15 + 1e-12)
        << m;
  }
  test::Random random(4);
  for (int i = 0; i < tries; ++i) {
    const double quarters = std::nearbyint(random.real(-1e6, 1e6));
    const DoubleDouble x = quarters * 1.5707963267948966;
    EXPECT_LE(relative_error(evaluate(Function::sin, x), sinq(quad(x))), 2e-31) << quarters;
    EXPECT_LE(relative_error(evaluate(Function::cos, x), cosq(quad(x))), 2e-31) << quarters;
  }
}

TEST(ElementaryFunctions, RaiseToAnyPower) {
  test::Random random(5);
  for (int i = 0; i < tries; ++i) {
    const DoubleDouble x = random_between(random, 0, 10), c = random_between(random, -3, 3);
    const double factor = 1 + std::abs(c.high * std::log(x.high));
    EXPECT_LE(relative_error(power(x, c), powq(quad(x), quad(c))), 2e-31 * factor) << x.high << " " << c.high;
  }
  EXPECT_EQ(power(DoubleDouble(-2.0), DoubleDouble(3.0)).high, -8);
  EXPECT_EQ(power(DoubleDouble(-2.0), DoubleDouble(-2.0)).high, 0.25);
  EXPECT_TRUE(std::isnan(power(DoubleDouble(-2.0), DoubleDouble(0.5)).high));
  EXPECT_EQ(power(DoubleDouble(0.0), DoubleDouble(0.5)).high, 0);
}

TEST(ElementaryFunctions, HaveNoValueWhereTheyAreNotDefined) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isnan(evaluate(Function::log, DoubleDouble(-1)).high));
  EXPECT_TRUE(std::isnan(evaluate(Function::asin, DoubleDouble(1, 1e-30)).high));
  EXPECT_TRUE(std::isnan(evaluate(Function::acos, DoubleDouble(-1.5)).high));
  EXPECT_TRUE(std::isnan(evaluate(Function::sin, DoubleDouble(1e15)).high)) << "an angle without a direction";
  EXPECT_EQ(evaluate(Function::log, DoubleDouble(0)).high, -infinity);
  EXPECT_EQ(evaluate(Function::exp, DoubleDouble(800)).high, infinity);
  EXPECT_EQ(evaluate(Function::exp, DoubleDouble(-800)).high, 0);
  EXPECT_EQ(evaluate(Function::asin, DoubleDouble(1)).high, std::acos(0.0));
  EXPECT_EQ(evaluate(Function::tanh, DoubleDouble(-1000)).high, -1);
}

TEST(DoubleDoubleSystem, SolvesWhatItsMatrixTimesAVectorGives) {
  test::Random random(6);
  for (int i = 0; i < 200; ++i) {
    const auto n = static_cast<std::size_t>(1 + i % 7);
    std::vector<DoubleDouble> m, x, b(n);
    for (std::size_t k = 0; k < n * n; ++k) m.push_back(random_between(random, -1, 1));
    for (std::size_t k = 0; k < n; ++k) x.push_back(random_between(random, -1, 1));
    for (std::size_t k = 0; k < n * n; ++k) b[k / n] = b[k / n] + m[k] * x[k % n];
    RowOrder order{};
    ASSERT_TRUE(factor_linear(n, m, order));
    substitute_linear(n, m, order, b);
    for (std::size_t k = 0; k < n; ++k) EXPECT_NEAR((b[k] - x[k]).high, 0, 1e-26);
  }
  std::vector<DoubleDouble> singular{1.0, 2.0, 0.5, 1.0};
  RowOrder order{};
  EXPECT_FALSE(factor_linear(2, singular, order));
}

}  // namespace
}  // namespace qdot
