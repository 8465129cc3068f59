// Factors against the products that they were multiplied to.

#include "core/expr/linear_factors.hpp"

#include <gtest/gtest.h>

#include "core/expr/rational_roots.hpp"

namespace qdot {
namespace {

class LinearFactors : public ::testing::Test {
 protected:
  Graph graph;
  Expression x = graph.symbol("x"), r = graph.symbol("r"), a = graph.symbol("a");

  Expression number(std::int64_t p, std::int64_t q = 1) { return graph.number(Number::ratio(p, q)); }

  /// How many factors are split off one after another.
  [[nodiscard]] static int count(const Expression& product) {
    Polynomial rest = multiplied_out(product);
    int found = 0;
    while (const auto factor = linear_factor(rest)) {
      const auto quotient = exact_quotient(rest, *factor);
      if (!quotient) return -1;
      rest = *quotient;
      ++found;
    }
    return found;
  }
};

TEST_F(LinearFactors, LinesAreFoundAllButTheLast) {
  const Expression first = x - number(1) - r, second = x + number(1) - number(2) * r,
                   third = number(3) * x - number(77, 100) + number(31, 9) * r;
  EXPECT_EQ(count(first * second), 1);
  EXPECT_EQ(count(first * second * third), 2);
  EXPECT_EQ(count(first * second * third * (x - number(5))), 3);
}

TEST_F(LinearFactors, CurvesMayBendAndHaveOtherSymbolsInThem) {
  EXPECT_EQ(count((x - r * r + a) * (x * x - r)), 1);
  EXPECT_EQ(count((a * x - r) * (x * x + a * r + number(1))), 1);
  EXPECT_EQ(count((r - x * x + number(1)) * (r - x * x * x)), 1);
  EXPECT_EQ(count((r - sin(x)) * (r + a * x)), 1);
}

TEST_F(LinearFactors, WhatHasNoneStaysWhole) {
  for (const Expression& e :
       {x * x * x + x * x - r * r, x * x + r * r, x * x - number(2) * r * r,
        (x * x - r * r - number(1)) * (x * x - number(2) * r * r + number(3)), pow(x, Number(5)) - x - r * r})
    EXPECT_FALSE(linear_factor(multiplied_out(e)));
}

TEST(RationalRoots, AreExactHoweverManyDigitsTheyHave) {
  const Number third = Number::ratio(1, 3), large = power(Number(10), 30) + Number::ratio(1, 7);
  const std::vector<Number> c{third * large, -third - large, Number(1)};  // (x - third) (x - large)
  EXPECT_EQ(rational_roots(c), (std::vector<Number>{third, large}));
  EXPECT_TRUE(rational_roots(std::vector<Number>{Number(-2), Number(0), Number(1)}).empty());
  EXPECT_EQ(rational_roots(std::vector<Number>{Number(0), Number(-6), Number(5), Number(1)}),
            (std::vector<Number>{Number(-6), Number(0), Number(1)}));
}

}  // namespace
}  // namespace qdot
