// Integrals of sqrt(p/q) against closed forms.

#include "core/numerics/root_quadrature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace qdot {
namespace {

/// a + b t with n + 1 coefficients, all exact.
std::vector<Ball> linear(double a, double b, std::size_t n) {
  std::vector<Ball> coefficients(n + 1);
  coefficients[0] = a;
  coefficients[1] = b;
  return coefficients;
}

TEST(RootQuadrature, OfOneOverARootIsItsClosedForm) {
  for (const double b : {0.0, 0.01, 0.1, 0.3}) {
    const auto p = linear(1, 0, 16), q = linear(1, b, 16);
    const EnclosedIntegral found = integral_of_root({p}, {q}, -1, 1);
    const Ball plus = sqrt(Ball(1) + Ball(b)), minus = sqrt(Ball(1) - Ball(b));
    const Ball expected = Ball(4) / (plus + minus);  // (2/b)(sqrt(1 + b) - sqrt(1 - b))
    EXPECT_TRUE((found.value - expected).contains_zero()) << b;
    EXPECT_LT(found.value.radius, 1e-28 + found.truncation);
    EXPECT_LT(found.truncation, 10 * std::pow(b, 16) + 1e-280);
  }
}

TEST(RootQuadrature, OfASlopingNumeratorOverPartOfThePiece) {
  // integral_0^1 sqrt(1 + b t) dt = (2/3b)((1 + b)^(3/2) - 1).
  for (const double b : {0.0625, 0.125}) {
    const auto p = linear(1, b, 16), q = linear(1, 0, 16);
    const EnclosedIntegral found = integral_of_root({p}, {q}, 0, 1);
    const Ball expected = Ball(2) / (Ball(3) * Ball(b)) * (power(Ball(1) + Ball(b), 1.5) - Ball(1));
    EXPECT_TRUE((found.value - expected).contains_zero()) << b;
    EXPECT_LT(found.value.radius, 1e-14);
  }
}

TEST(RootQuadrature, CountsWhatTheLastCoefficientLeavesOpen) {
  auto p = linear(1, 0, 8), q = linear(1, 0.1, 8);
  q[8] = Ball::of(Interval(-1e-3, 1e-3));
  const EnclosedIntegral found = integral_of_root({p}, {q}, -1, 1);
  for (const double last : {-1e-3, 0.0, 1e-3}) {
    double sum = 0;  // Simpson's rule
    constexpr int pieces = 2000;
    for (int i = 0; i <= pieces; ++i) {
      const double t = -1 + 2.0 * i / pieces;
      const double weight = i == 0 || i == pieces ? 1 : i % 2 == 1 ? 4 : 2;
      sum += weight / std::sqrt(1 + 0.1 * t + last * std::pow(t, 8)) * (2.0 / pieces) / 3;
    }
    EXPECT_TRUE(found.value.interval().contains(sum)) << last;
  }
  EXPECT_GT(found.truncation, 1e-4);
}

TEST(RootQuadrature, HasNoValueWhereTheDenominatorMayVanish) {
  const auto p = linear(1, 0, 4), q = linear(1, 1.5, 4);
  EXPECT_FALSE(integral_of_root({p}, {q}, -1, 1).value.is_finite());
}

}  // namespace
}  // namespace qdot
