// Whether a full turn of an angle changes an expression, as its form shows.

#include "core/expr/full_turn.hpp"

#include <gtest/gtest.h>

#include "core/expr/parse.hpp"

namespace qdot {
namespace {

class FullTurn : public testing::Test {
 protected:
  bool turns(const std::string& text) {
    static const std::vector<std::string> names{"x", "y", "k"};
    return has_full_turn(parse(text, graph, names), graph.symbol("x"));
  }
  Graph graph;
};

TEST_F(FullTurn, LeavesCircularFunctionsOfWholeMultiplesAsTheyAre) {
  EXPECT_TRUE(turns("k*y"));
  EXPECT_TRUE(turns("k*sin(x) + cos(3*x)^2*y"));
  EXPECT_TRUE(turns("tan(y - 2*x)"));
  EXPECT_TRUE(turns("cos(2*(y - x) + 1/3)"));
  EXPECT_TRUE(turns("exp(sin(cos(x)))"));
}

TEST_F(FullTurn, ChangesTwoSignsOfHalfAnAngleToNoEffect) {
  EXPECT_TRUE(turns("sqrt(k - sin(x/2)^2)"));
  EXPECT_TRUE(turns("sin(x/2)*cos(3*x/2 + 1)/sqrt(y - cos(x/2)^2)"));
  EXPECT_TRUE(turns("tan(x/2)*abs(sin(x/2))"));
  EXPECT_TRUE(turns("(sin(x/2) - 2*cos(x/2))^2"));
  EXPECT_FALSE(turns("sin(x/2)^3"));
  EXPECT_FALSE(turns("(1 + sin(x/2))^2"));
  EXPECT_FALSE(turns("exp(sin(x/2))"));
  EXPECT_FALSE(turns("sin(x/3)^2"));
  EXPECT_FALSE(turns("x*sin(x/2)^2"));
}

TEST_F(FullTurn, ChangesEverythingElse) {
  EXPECT_FALSE(turns("x"));
  EXPECT_FALSE(turns("sin(x) + x^2"));
  EXPECT_FALSE(turns("sin(x/2)"));
  EXPECT_FALSE(turns("sin(k*x)"));
  EXPECT_FALSE(turns("cos(x^2)"));
  EXPECT_FALSE(turns("exp(x)"));
}

TEST_F(FullTurn, MakesNoExpressionsToFindOut) {
  static const std::vector<std::string> names{"x", "y"};
  const Expression e = parse("cos(2*(y - x))*sin(x/2)", graph, names);
  const Expression x = graph.symbol("x");
  const std::size_t before = graph.size();
  EXPECT_FALSE(has_full_turn(e, x));
  EXPECT_EQ(graph.size(), before);
}

}  // namespace
}  // namespace qdot
