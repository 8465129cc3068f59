// Roots of c0 + c1 u + c2 u^2 that are known, and why there may be none.

#include "core/steady/quadratic_roots.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace qdot {
namespace {

using Outcome = QuadraticRoots::Outcome;

QuadraticRoots roots(double c0, double c1, double c2) {
  const std::vector<Interval> c{c0, c1, c2};
  return quadratic_roots(c, c);
}

TEST(QuadraticRoots, EnclosesBothRoots) {
  const QuadraticRoots found = roots(6, -5, 1);
  ASSERT_EQ(found.values.size(), 2u);
  EXPECT_TRUE(found.values[0].contains(3.0));
  EXPECT_TRUE(found.values[1].contains(2.0));
}

TEST(QuadraticRoots, LosesNoDigitsOfARootThatIsMuchSmallerThanTheOther) {
  const QuadraticRoots found = roots(1e-12, -1, 1);  // 1e-12 + 1e-24 + ..., and nearly 1
  ASSERT_EQ(found.values.size(), 2u);
  EXPECT_NEAR(found.values[1].middle(), 1e-12 * (1 + 1e-12), 1e-27);
  EXPECT_LT(found.values[1].width(), 1e-26);
}

TEST(QuadraticRoots, SolvesALinearEquation) {
  const QuadraticRoots found = roots(3, -2, 0);
  ASSERT_EQ(found.values.size(), 1u);
  EXPECT_TRUE(found.values[0].contains(1.5));
}

TEST(QuadraticRoots, OfASquareAreOppositeOrOneZero) {
  EXPECT_EQ(roots(-4, 0, 1).values.size(), 2u);
  ASSERT_EQ(roots(0, 0, 1).values.size(), 1u);
  EXPECT_TRUE(roots(0, 0, 1).values[0].contains(0.0));
}

TEST(QuadraticRoots, TooNearToBeToldApartAreOneThatHoldsBoth) {
  const QuadraticRoots found = roots(2.3 * (2.3 + 1e-10), -(4.6 + 1e-10), 1);
  ASSERT_EQ(found.values.size(), 1u);
  EXPECT_TRUE(found.may_be_two);
  EXPECT_TRUE(found.values[0].contains(2.3));
  EXPECT_TRUE(found.values[0].contains(2.3 + 1e-10));
  EXPECT_FALSE(roots(6, -5, 1).may_be_two);
}

TEST(QuadraticRoots, SayWhyThereAreNone) {
  EXPECT_EQ(roots(1, 1, 1).outcome, Outcome::not_real);
  EXPECT_EQ(roots(8, 0, 2).outcome, Outcome::negative_square);
  EXPECT_NEAR(roots(8, 0, 2).square, -4, 1e-14);
  EXPECT_EQ(roots(1, 0, 0).outcome, Outcome::at_infinity);
  EXPECT_EQ(roots(std::numeric_limits<double>::infinity(), 1, 1).outcome, Outcome::undefined);
}

}  // namespace
}  // namespace qdot
