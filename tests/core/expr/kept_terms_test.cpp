#include "core/expr/kept_terms.hpp"

#include <gtest/gtest.h>

#include "core/expr/parse.hpp"
#include "core/expr/print/print.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

class KeptTerms : public testing::Test {
 protected:
  [[nodiscard]] Expression parsed(const std::string& text) {
    const std::vector<std::string> names{"x", "c", "w", "m", "g", "l", "theta"};
    return parse(text, graph_, names);
  }
  Graph graph_;
};

TEST_F(KeptTerms, AreThoseThatLoseDigitsMultipliedOut) {
  for (const char* text : {"exp(-((x - c)/w)^2)", "1/(1 + ((x - c)/w)^8)", "m*(x - c)^3",
                           "tanh((x - c)*(x + c))", "sqrt((x - c)^2 + w^2)", "(x - c)^2*(x + c)^2"}) {
    EXPECT_TRUE(loses_digits_multiplied_out(parsed(text))) << text;
  }
  for (const char* text : {"m*(x - c)^2/2", "m*g*l*cos(theta - c)", "exp(-x^2)", "tanh((x - c)/w)",
                           "m/(x - c)", "sin(theta)^4", "(l + l*cos(theta))*x", "sqrt(x^2 + l^2)"}) {
    EXPECT_FALSE(loses_digits_multiplied_out(parsed(text))) << text;
  }
}

TEST_F(KeptTerms, StayAsTheyAreAmongTermsThatAreShortened) {
  const Expression e = parsed("m*(sin(theta)^2 + cos(theta)^2) + exp(-((x - c)/w)^2)");
  EXPECT_EQ(shortened(e), parsed("m + exp(-((x - c)/w)^2)"));
}

TEST_F(KeptTerms, StayAsTheyAreWhenTheyAreDifferentiated) {
  const Expression x = parsed("x");
  EXPECT_EQ(shortened_derivative(parsed("(x - c)^3 - w*x"), x), parsed("3*(x - c)^2 - w"));
  EXPECT_EQ(shortened_derivative(parsed("m*(x - c)^2/2 + g*x"), x), simplify(parsed("m*(x - c) + g")));
}

}  // namespace
}  // namespace qdot
