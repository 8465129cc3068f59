// What is left of equations against a solution that was known before.

#include "core/steady/linear_unknowns.hpp"

#include <gtest/gtest.h>

#include <array>

#include "core/expr/calculus.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

class LinearUnknownsOf : public ::testing::Test {
 protected:
  [[nodiscard]] LinearUnknowns left(const std::vector<Expression>& equations,
                                    const std::vector<bool>& may_go = {true, true}) {
    return without_linear_unknowns(equations, unknowns, may_go, constants, p);
  }

  Graph graph;
  Expression x = graph.symbol("x"), y = graph.symbol("y"), p = graph.symbol("p"), k = graph.symbol("k");
  std::vector<Expression> unknowns{x, y}, constants{k};
};

TEST_F(LinearUnknownsOf, AnUnknownThatStandsLinearlyIsPutIn) {
  const LinearUnknowns found = left({k * y - x * x, pow(x, Number(3)) + y - p});
  ASSERT_EQ(found.unknowns, (std::vector<std::size_t>{0}));
  EXPECT_EQ(found.values[0], x);
  EXPECT_TRUE(simplify(found.values[1] - x * x / k).is_zero());
  ASSERT_EQ(found.equations.size(), 1U);
  EXPECT_TRUE(simplify(found.equations[0] - (pow(x, Number(3)) + x * x / k - p)).is_zero());
}

TEST_F(LinearUnknownsOf, ACombinationOfTwoMayBeLinear) {
  const Expression u = Number(2) * x + y, w = x - Number(3) * y - graph.number(1);
  const Expression bent = pow(u, Number(3)) - p * u;
  const LinearUnknowns found = left({simplify(Number(2) * bent + w), simplify(bent - Number(3) * w)});
  ASSERT_EQ(found.unknowns.size(), 1U);
  ASSERT_EQ(found.equations.size(), 1U);
  const std::vector<Replacement> place{{x, found.values[0]}, {y, found.values[1]}};
  EXPECT_TRUE(simplify(substitute(w, place)).is_zero());
}

TEST_F(LinearUnknownsOf, NothingIsDividedByWhatMayVanish) {
  for (const Expression& equation : {p * y - x, (k - graph.number(1)) * y - x, y - x / p}) {
    EXPECT_EQ(left({equation, x * x * y * y - p}, {false, true}).unknowns.size(), 2U);
  }
}

TEST_F(LinearUnknownsOf, OnesThatMayNotGoStay) {
  EXPECT_EQ(left({y - x * x, x * y * y - p}, {false, false}).unknowns.size(), 2U);
}

}  // namespace
}  // namespace qdot
