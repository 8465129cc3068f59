// What is left of a Lagrangian whose time is only in a total derivative.

#include "core/mechanics/explicit_time.hpp"

#include <gtest/gtest.h>

#include "core/expr/parse.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

class ExplicitTime : public testing::Test {
 protected:
  Expression read(const std::string& text) {
    return parse(text, graph_,
                 std::vector<std::string>{"m", "l", "g", "a", "w", "x", "x_dot", "y", "y_dot", "t"});
  }
  /// Whether `text` without its derivative is `left`.
  bool leaves(const std::string& text, const std::string& left) {
    const auto found = without(text);
    return found && simplify(*found - read(left)).is_zero();
  }
  std::optional<Expression> without(const std::string& text) {
    const std::vector<Expression> q{read("x"), read("y")}, rates{read("x_dot"), read("y_dot")};
    return without_explicit_time(read(text), q, rates, read("t"));
  }

  Graph graph_;
};

TEST_F(ExplicitTime, LeavesAnAcceleratingFrameAsAPotential) {
  EXPECT_TRUE(leaves("m*(x_dot + a*t)^2/2", "m*x_dot^2/2 - m*a*x"));
  EXPECT_TRUE(leaves("m*l^2*x_dot^2/2 + m*l*a*t*x_dot*cos(x) + m*a^2*t^2/2 + m*g*l*cos(x)",
                     "m*l^2*x_dot^2/2 + m*g*l*cos(x) - m*l*a*sin(x)"));
  EXPECT_TRUE(leaves("x_dot^2/2 + y_dot^2/2 + a*t*(x_dot*exp(-w*x) + 2*y*y_dot)",
                     "x_dot^2/2 + y_dot^2/2 + a*exp(-w*x)/w - a*y^2"));
}

TEST_F(ExplicitTime, StaysWhereItDoesWork) {
  EXPECT_FALSE(without("x_dot^2/2"));                            // there is none
  EXPECT_FALSE(without("x_dot^2/2 - a*cos(w*t)*x_dot*sin(x)"));  // a pivot that is shaken
  EXPECT_FALSE(
      without("x_dot^2/2 + y_dot^2/2 + a*t*(x*y_dot - y*x_dot)"));  // a field that grows turns charges
  EXPECT_FALSE(without("(m - a*t)*x_dot^2/2"));
}

}  // namespace
}  // namespace qdot
