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

}  // namespace
}  // namespace qdot
