// Factors against the products that they were multiplied to.

#include "core/steady/factors.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/expr/polynomial.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

class FactorsAlong : public ::testing::Test {
 protected:
  /// c0 + c1 x + c2 p
  Expression line(int c0, int c1, int c2) {
    return graph.number(Number::ratio(c0, 7)) + Number(c1) * x + Number(c2) * p;
  }

  Graph graph;
  Expression x = graph.symbol("x"), p = graph.symbol("p"), g = graph.symbol("g");
};

bool is_multiple(const Expression& a, const Expression& b) {
  const auto quotient = exact_quotient(multiplied_out(a), multiplied_out(b));
  return quotient && quotient->size() == 1 && quotient->begin()->first.empty();
}

bool has(const std::vector<Factor>& factors, const Expression& base, bool is_repeated) {
  return std::ranges::any_of(
      factors, [&](const Factor& f) { return f.is_repeated == is_repeated && is_multiple(f.base, base); });
}

TEST_F(FactorsAlong, ARootThatIsTheSameForEveryParameterIsSplitOff) {
  const Expression u = line(-3, 1, 0), rest = pow(u, Number(2)) - line(2, 0, 5);
  const auto found = factors_along(expand(u * rest), p);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_TRUE(has(found, u, false));
  EXPECT_TRUE(has(found, rest, false));
}

TEST_F(FactorsAlong, PowersAreFoundOnceAndSaidToBeRepeated) {
  for (int power = 2; power <= 6; ++power) {
    for (const Expression& u : {line(-3, 2, 0), line(1, 3, -2), x, g * x - p}) {
      const auto found = factors_along(expand(pow(u, Number(power)) * line(5, 1, 1)), p);
      ASSERT_EQ(found.size(), 2U) << power;
      EXPECT_TRUE(has(found, u, true)) << power;
      EXPECT_TRUE(has(found, line(5, 1, 1), false)) << power;
    }
  }
}

TEST_F(FactorsAlong, ASymbolAloneIsNotRepeated) {
  const auto found = factors_along(Number(2) * x, p);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found[0].is_repeated);
}

TEST_F(FactorsAlong, CurvesThatMoveWithTheParameterAreSplitOff) {
  const Expression first = line(-3, 1, 2), second = line(5, -2, 1), rest = x * x - line(2, 0, 5);
  const auto found = factors_and_curves(expand(first * second * rest), p);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_TRUE(has(found, first, false));
  EXPECT_TRUE(has(found, second, false));
  EXPECT_TRUE(has(found, rest, false));
}

TEST_F(FactorsAlong, SoAreFunctionsOfTheParameter) {
  const auto found = factors_and_curves(expand(sin(x - p) * (cos(x - p) - g * p)), p);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_TRUE(has(found, sin(x - p), false));
}

TEST_F(FactorsAlong, MultiplesOfAnAngleThatMovesAreSplitByTheAngle) {
  const Expression u = x - Number::ratio(13, 10) * p - graph.number(Number::ratio(22, 25));
  const auto found = factors_and_curves(expand(sin(expand(Number(2) * u)) - g * p * sin(u)), p);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_TRUE(has(found, sin(u), false));
}

TEST_F(FactorsAlong, WhatIsNoPolynomialInTheParameterStaysWhole) {
  for (const Expression& e : {sin(p) * x + x * x, x / p + g}) {
    const auto found = factors_along(e, p);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].base, e);
  }
}

}  // namespace
}  // namespace qdot
