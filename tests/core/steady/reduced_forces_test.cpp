#include "core/steady/reduced_forces.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/expr/parse.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

class ReducedTest : public testing::Test {
 protected:
  [[nodiscard]] Expression parsed(const std::string& text) {
    const std::vector<std::string> names{"x", "y", "z", "k"};
    return parse(text, graph_, names);
  }
  [[nodiscard]] std::vector<Expression> reduced(const std::vector<std::string>& texts) {
    std::vector<Expression> equations;
    for (const std::string& text : texts) equations.push_back(parsed(text));
    const std::vector<Expression> variables{parsed("x"), parsed("y"), parsed("z")};
    return reduced_equations(equations, variables);
  }

 private:
  Graph graph_;
};

TEST_F(ReducedTest, TakeAwayWhatTheSlopeOfAnInnerFunctionMultiplies) {
  EXPECT_THAT(reduced({"(x + y^2)^3 - (x + y^2)", "2*y*((x + y^2)^3 - (x + y^2)) + k*y"}),
              testing::Contains(simplify(parsed("k*y"))));
  EXPECT_THAT(reduced({"(x + sin(y))^3 - x - sin(y)", "cos(y)*((x + sin(y))^3 - x - sin(y)) + k*y"}),
              testing::Contains(simplify(parsed("k*y"))));
}

TEST_F(ReducedTest, KnowThreeEquations) {
  EXPECT_THAT(reduced({"x*y - z", "x*y*z - z^2 + x", "y"}), testing::Contains(parsed("x")));
}

TEST_F(ReducedTest, TakeTheMomentInWhichCentralForcesAreGone) {
  EXPECT_THAT(
      reduced({"x*(x^2 + y^2)^(-3/2) - x*exp(x^2 + y^2) + k", "y*(x^2 + y^2)^(-3/2) - y*exp(x^2 + y^2)"}),
      testing::Contains(parsed("k*y")));
}

TEST_F(ReducedTest, MultiplyByNothingThatMayBeInfinite) {
  EXPECT_TRUE(reduced({"x", "1 + x/y"}).empty());
  EXPECT_TRUE(reduced({"x", "y + x*log(y)"}).empty());
  EXPECT_FALSE(reduced({"x", "y + x*sin(y)"}).empty());
  EXPECT_FALSE(reduced({"x", "y + x/k"}).empty());  // a number
}

TEST_F(ReducedTest, ThereAreNoneOfOneOrOfFour) {
  EXPECT_TRUE(reduced({"x^2 - 1"}).empty());
  EXPECT_TRUE(reduced({"x", "x*y", "x*z", "x*k"}).empty());
}

}  // namespace
}  // namespace qdot
