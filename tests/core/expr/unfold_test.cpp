// Kinks as functions of the sides on which a place is.

#include "core/expr/unfold.hpp"

#include <gtest/gtest.h>

#include "core/expr/parse.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

class Unfolding : public testing::Test {
 protected:
  [[nodiscard]] Expression parsed(const std::string& text) {
    const std::vector<std::string> names{"x", "c", "w"};
    return parse(text, graph_, names);
  }
  [[nodiscard]] Unfolded unfolded_along_x(const std::string& text) {
    const Expression e = parsed(text);
    const Expression x = parsed("x");
    return unfolded({&e, 1}, {&x, 1});
  }
  Graph graph_;
};

TEST_F(Unfolding, KeepsTheDigitsOfAnArgument) {
  const Unfolded pieces = unfolded_along_x("exp(-abs(((x - c)/w)^3))");
  ASSERT_EQ(pieces.arguments.size(), 1);
  EXPECT_EQ(split_coefficient(pieces.arguments[0]).rest, split_coefficient(parsed("((x - c)/w)^3")).rest);
  const Unfolded window = unfolded_along_x("sign(1 - ((x - c)/w)^2)*x");
  ASSERT_EQ(window.arguments.size(), 1);
  EXPECT_TRUE(window.arguments[0] == parsed("1 - ((x - c)/w)^2") ||
              window.arguments[0] == parsed("((x - c)/w)^2 - 1"));
}

TEST_F(Unfolding, KnowsAnArgumentAgainHoweverItIsWritten) {
  const Unfolded pieces =
      unfolded_along_x("abs(2 - 2*(x - c)^2) + sign((x - c)^2 - 1) + abs(1 - x^2 + 2*c*x - c^2)");
  ASSERT_EQ(pieces.arguments.size(), 1);
  const std::vector<Replacement> ahead{{pieces.sides[0], graph_.number(1)}};
  // on the side where (x - c)^2 - 1 has the sign of the argument
  const bool outside = simplify(pieces.arguments[0] - parsed("2*(x - c)^2 - 2")).is_zero() ||
                       simplify(pieces.arguments[0] - parsed("(x - c)^2 - 1")).is_zero();
  const Expression there = parsed(outside ? "3*(x - c)^2 - 3 + 1" : "3 - 3*(x - c)^2 - 1");
  EXPECT_TRUE(simplify(substitute(pieces.smooth[0], ahead) - there).is_zero());
}

TEST_F(Unfolding, TakesMultiplesOfOneArgumentForOneKink) {
  EXPECT_EQ(unfolded_along_x("sign(x - 0.3) + sign(3*x - 0.9) + abs(0.6 - 2*x)").sides.size(), 1);
  const Unfolded by_parameter = unfolded_along_x("abs(x) + abs(c*x)");
  ASSERT_EQ(by_parameter.sides.size(), 1);
  const std::vector<Replacement> below{{by_parameter.sides[0], graph_.number(-1)}};
  EXPECT_TRUE(simplify(substitute(by_parameter.smooth[0], below) - parsed("-x - sign(c)*c*x")).is_zero());
  for (const std::string text :
       {"abs(c*x) + abs(w*x)", "sign(c*x - c) + abs(x - 1)", "abs(x/c - 2/w) + abs(3*w*x - 6*c)",
        "abs(c*x - w) + sign(-2*c^2*x + 2*c*w)"})
    EXPECT_EQ(unfolded_along_x(text).sides.size(), 1) << text;
  EXPECT_EQ(unfolded_along_x("abs(c*x) + abs(w*x - 1)").sides.size(), 2);
  EXPECT_EQ(unfolded_along_x("abs(x) + abs(x - 1)").sides.size(), 2);
}

TEST_F(Unfolding, KnowsTheRootOfASquareBesideConstants) {
  for (const std::string text :
       {"sqrt(c^2*x^2)", "sqrt(4*x^2)", "sqrt(w*x^2)", "(c*x^2)^1.5", "sqrt(c*x^2 + w*x^2)",
        "sqrt(x^2 - x + 0.25)", "sqrt((x - 1)^2*(x^2 + 1))", "sqrt(abs(x)^2)"})
    EXPECT_EQ(unfolded_along_x(text).sides.size(), 1) << text;
  const Unfolded pieces = unfolded_along_x("sqrt(w*x^2)");
  EXPECT_EQ(pieces.smooth[0], simplify(pieces.sides[0] * parsed("sqrt(w)*x")));
}

}  // namespace
}  // namespace qdot
