// Divided differences enclose what long double arithmetic finds, and lose no digits where places meet.

#include "core/numerics/divided_difference.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random.hpp"

namespace qdot::divided_difference_test {
namespace {

using Real = long double;

/// What the test knows of a function: f and f' in long double.
struct Known {
  Function function;
  Real (*value)(Real);
  Real (*derivative)(Real);
  double low, high;
};

const Known known[]{
    {Function::sin, [](Real x) { return std::sin(x); }, [](Real x) { return std::cos(x); }, -9, 9},
    {Function::cos, [](Real x) { return std::cos(x); }, [](Real x) { return -std::sin(x); }, -9, 9},
    {Function::tan, [](Real x) { return std::tan(x); }, [](Real x) { return 1 + std::tan(x) * std::tan(x); },
     -1.5, 1.5},
    {Function::exp, [](Real x) { return std::exp(x); }, [](Real x) { return std::exp(x); }, -5, 5},
    {Function::log, [](Real x) { return std::log(x); }, [](Real x) { return 1 / x; }, 0.01, 9},
    {Function::sinh, [](Real x) { return std::sinh(x); }, [](Real x) { return std::cosh(x); }, -4, 4},
    {Function::cosh, [](Real x) { return std::cosh(x); }, [](Real x) { return std::sinh(x); }, -4, 4},
    {Function::tanh, [](Real x) { return std::tanh(x); },
     [](Real x) { return 1 - std::tanh(x) * std::tanh(x); }, -3, 3},
    {Function::atan, [](Real x) { return std::atan(x); }, [](Real x) { return 1 / (1 + x * x); }, -9, 9},
    {Function::asin, [](Real x) { return std::asin(x); }, [](Real x) { return 1 / std::sqrt(1 - x * x); },
     -0.99, 0.99},
    {Function::acos, [](Real x) { return std::acos(x); }, [](Real x) { return -1 / std::sqrt(1 - x * x); },
     -0.99, 0.99},
    {Function::abs, [](Real x) { return std::abs(x); }, [](Real x) -> Real { return (x > 0) - (x < 0); }, -2,
     2},
};

/// Places at all distances, 1 to 1e-15.
double near(test::Random& random, const Known& f, double a) {
  const double b = a + random.real(-1, 1) * std::pow(10, -random.real(0, 15));
  return b > f.low && b < f.high ? b : a;
}

/// The divided difference by the quotient, and between near places by the derivative in the middle, whose
/// error is of second order; with the error of whichever is used.
std::pair<Real, Real> expected(const Known& f, double a, double b) {
  const Real d = static_cast<Real>(b) - a;
  const Real quotient = (f.value(b) - f.value(a)) / d;
  const Real rounding = 4e-19L * (std::abs(f.value(a)) + std::abs(f.value(b))) / std::abs(d);
  const Real middle = f.derivative((static_cast<Real>(a) + b) / 2);
  if (d != 0 && rounding < 1e-11L * std::abs(middle)) return {quotient, rounding};
  return {middle, 1e-18L * std::abs(middle) + 1e4L * d * d};
}

TEST(DividedDifference, OfEachFunctionHoldsTheTrueValue) {
  test::Random random(31);
  for (const Known& f : known) {
    for (int i = 0; i < 2000; ++i) {
      const double a = random.real(f.low, f.high);
      const double b = near(random, f, a);
      const DividedDifference u = evaluate(f.function, DividedDifference::variable(a, b));
      const auto [value, error] = expected(f, a, b);
      EXPECT_GE(value + error, u.slope.lower) << name(f.function) << ' ' << a << ' ' << b;
      EXPECT_LE(value - error, u.slope.upper) << name(f.function) << ' ' << a << ' ' << b;
      EXPECT_GE(f.value(b) * (1 + 1e-18L * (f.value(b) > 0 ? 1 : -1)), u.at_b.lower);
    }
  }
}

TEST(DividedDifference, OfTheUsualFunctionsKeepsItsDigitsAtAllDistances) {
  test::Random random(32);
  for (const Known& f : known) {
    if (f.function == Function::asin || f.function == Function::acos || f.function == Function::abs) continue;
    for (int i = 0; i < 500; ++i) {
      const double a = random.real(f.low, f.high);
      const double b = near(random, f, a);
      const Interval slope = evaluate(f.function, DividedDifference::variable(a, b)).slope;
      const double size = std::max({std::abs(static_cast<double>(f.derivative(a))),
                                    std::abs(static_cast<double>(f.derivative(b))), slope.magnitude()});
      EXPECT_LT(slope.width(), (1e-14 * size + 1e-15) * (1 + std::abs(a)))
          << name(f.function) << ' ' << a << ' ' << b;
    }
  }
}

TEST(DividedDifference, OverAPieceHoldsThoseOfItsPlaces) {
  test::Random random(33);
  for (const Known& f : known) {
    for (int i = 0; i < 1000; ++i) {
      const double a = random.real(f.low, f.high);
      const double p = random.real(f.low, f.high), q = random.real(f.low, f.high);
      const Interval piece(std::min(p, q), std::max(p, q));
      const double b = random.real(piece.lower, piece.upper);
      const Interval whole = evaluate(f.function, DividedDifference::variable(a, piece)).slope;
      const Interval one = evaluate(f.function, DividedDifference::variable(a, b)).slope;
      EXPECT_LE(whole.lower, one.upper) << name(f.function);
      EXPECT_GE(whole.upper, one.lower) << name(f.function);
      const auto [value, error] = expected(f, a, b);
      EXPECT_GE(value + error, whole.lower) << name(f.function);
      EXPECT_LE(value - error, whole.upper) << name(f.function);
    }
  }
}

TEST(DividedDifference, OfASumOfCosinesDoesNotCancel) {
  // 1 - cos between 1e-8 and 2e-8: a difference of 1.5e-16 of values that are 1.
  const DividedDifference u = cos(DividedDifference::variable(1e-8, 2e-8));
  EXPECT_NEAR(u.slope.middle(), -1.5e-8, 1e-22);
  EXPECT_LT(u.slope.width(), 1e-22);
}

}  // namespace
}  // namespace qdot::divided_difference_test
