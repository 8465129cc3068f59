// Taylor enclosures against values of the functions themselves, and against series that are known.

#include "core/numerics/taylor_enclosure.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random.hpp"

namespace qdot {
namespace {

using Enclosure = FineSeries;

/// f at x by its coefficients at the centre up to the order n, and the one over the piece for the rest.
Interval value_at(const Enclosure& f, double centre, double x, std::size_t n) {
  const Interval s = Interval(x) - Interval(centre);
  Interval sum(0), power(1);
  for (std::size_t k = 0; k <= n; ++k) {
    sum = sum + (k < n ? f.at[k].interval() : f.over[k]) * power;
    power = power * s;
  }
  return sum;
}

void expect_encloses(const Enclosure& f, double centre, double x, double expected, const std::string& what) {
  const double rounding = 4e-16 * (1 + std::abs(expected));
  for (std::size_t n = 0; n <= quadrature_order; ++n) {
    const Interval found = value_at(f, centre, x, n);
    EXPECT_LE(found.lower, expected + rounding) << what << " order " << n << " at " << x;
    EXPECT_GE(found.upper, expected - rounding) << what << " order " << n << " at " << x;
  }
}

TEST(TaylorEnclosure, OfEveryFunctionHoldsItsValuesAllOverThePiece) {
  test::Random random(3);
  for (std::size_t i = 0; i < function_names.size(); ++i) {
    const auto function = static_cast<Function>(i);
    for (int trial = 0; trial < 40; ++trial) {
      const double c = random.real(0.1, 0.7), h = random.real(0.001, 0.15);
      const auto x = Enclosure::variable(c, {c - h, c + h});
      const auto linear = Enclosure::literal(0.75) * x + Enclosure::literal(0.125);
      const auto bent = square(x) + x;
      const double place = c + h * random.real(-1, 1);
      expect_encloses(evaluate(function, linear), c, place, evaluate(function, 0.75 * place + 0.125),
                      std::string(name(function)) + " of a linear argument");
      if (place * place + place >= 0.99) continue;  // asin and acos end there
      expect_encloses(evaluate(function, bent), c, place, evaluate(function, place * place + place),
                      std::string(name(function)) + " of a quadratic one");
    }
  }
}

TEST(TaylorEnclosure, OfQuotientsRootsAndPowersHoldsTheirValues) {
  test::Random random(4);
  for (int trial = 0; trial < 100; ++trial) {
    const double c = random.real(0.5, 2), h = random.real(0.001, 0.2), t = c + h * random.real(-1, 1);
    const auto x = Enclosure::variable(c, {c - h, c + h});
    const auto v = square(x) + Enclosure::literal(1);
    const double at = t * t + 1;
    expect_encloses(x / v, c, t, t / at, "quotient");
    expect_encloses(sqrt(v), c, t, std::sqrt(at), "square root");
    for (const double p : {-3.0, -0.5, 1.5, 2.0, 5.0})
      expect_encloses(power(v, Enclosure::literal(p)), c, t, std::pow(at, p), "power");
  }
}

TEST(TaylorEnclosure, OfTheExponentialIsItsSeries) {
  const auto f = evaluate(Function::exp, Enclosure::variable(0, {-0.5, 0.5}));
  double factorial = 1;
  for (std::size_t k = 0; k <= quadrature_order; ++k) {
    if (k > 0) factorial *= static_cast<double>(k);
    EXPECT_TRUE((f.at[k] - Ball(1) / Ball(factorial)).contains_zero()) << k;
    EXPECT_LT(f.at[k].radius, 1e-29 / factorial);
    EXPECT_TRUE(f.over[k].contains(Interval(0.61, 1.64) / Interval(factorial)));
  }
}

TEST(TaylorEnclosure, FarFromAStepKnowsThatItsSlopesVanish) {
  const auto f = evaluate(Function::tanh, Enclosure::literal(1e5) * Enclosure::variable(0.1, {0.05, 0.15}));
  for (std::size_t k = 1; k <= quadrature_order; ++k) {
    EXPECT_LT(f.at[k].magnitude(), 1e-200) << k;
    EXPECT_LT(f.over[k].magnitude(), 1e-200) << k;
  }
}

TEST(TaylorEnclosure, OfPolynomialsKeepsTwiceTheDigits) {
  test::Random random(5);
  for (int trial = 0; trial < 100; ++trial) {
    const double c = random.real(-2, 2);
    const auto x = Enclosure::variable(c, {c - 0.1, c + 0.1});
    const auto sum = square(x + Enclosure::literal(-3) * square(x));  // x^2 - 6 x^3 + 9 x^4
    const Ball at(c), third = Ball(-6) + Ball(36) * at;               // a sixth of the third derivative
    EXPECT_TRUE((sum.at[3] - third).contains_zero());
    EXPECT_LT(sum.at[3].radius, 1e-27);
    EXPECT_TRUE(sum.over[3].contains(third.value()));
  }
}

TEST(TaylorEnclosure, KnowsThatAKinkInsideThePieceHasNoCurvature) {
  const auto across = evaluate(Function::abs, Enclosure::variable(0.1, {-0.2, 0.4}));
  EXPECT_TRUE(across.over[1].contains(Interval(-1, 1)));
  EXPECT_FALSE(across.over[2].is_finite());
  const auto beside = evaluate(Function::abs, Enclosure::variable(-0.1, {-0.2, 0.0}));
  EXPECT_EQ(beside.over[1].lower, -1);
  EXPECT_EQ(beside.over[1].upper, -1);
  EXPECT_TRUE(is_zero(beside.over[2]));
  const auto jump = evaluate(Function::sign, Enclosure::variable(0.1, {-0.2, 0.4}));
  EXPECT_FALSE(jump.over[1].is_finite());
}

TEST(TaylorEnclosure, OfAnExpandedSquareIsAsNarrowAsOfTheSquare) {
  const double c = 0.30155, h = 3e-6;  // 1e8 x^2 - 6e7 x + 9e6 = (1e4 (x - 0.3))^2
  const auto x = Enclosure::variable(c, {c - h, c + h});
  const auto y = Enclosure::literal(1e8) * square(x) + Enclosure::literal(-6e7) * x + Enclosure::literal(9e6);
  EXPECT_LT(y.over[0].width(), 1.1 * 4 * h * 1e8 * (c - 0.3));
}

}  // namespace
}  // namespace qdot
