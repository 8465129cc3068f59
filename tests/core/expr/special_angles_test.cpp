// Sines and cosines of known angles: as numbers, and with quarter turns taken out.

#include "core/expr/special_angles.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/expr/calculus.hpp"
#include "core/expr/parse.hpp"
#include "core/expr/print/print.hpp"

namespace qdot {
namespace {

std::string folded(const std::string& text) {
  Graph graph;
  const std::vector<std::string> names{"x", "y"};
  return print(with_special_angles(parse(text, graph, names)), Form::text);
}

TEST(SpecialAngles, HaveNumbersForSinesAndCosines) {
  EXPECT_EQ(folded("sin(pi/6)"), "1/2");
  EXPECT_EQ(folded("cos(2*pi/3)"), "-1/2");
  EXPECT_EQ(folded("cos(-7*pi)"), "-1");
  EXPECT_EQ(folded("sin(pi/5)"), "sin(1/5*pi)");
  for (int i = -24; i <= 24; ++i) {
    for (const char* function : {"sin", "cos"}) {
      Graph graph;
      const Expression e = parse(std::string(function) + "(" + std::to_string(i) + "*pi/12)", graph, {});
      EXPECT_NEAR(evaluate(with_special_angles(e), {}), evaluate(e, {}), 1e-14) << function << i;
    }
  }
}

TEST(SpecialAngles, LeaveTheRestOfAnAngle) {
  EXPECT_EQ(folded("sin(x + pi)"), "-sin(x)");
  EXPECT_EQ(folded("cos(pi/2 - x)"), "sin(x)");
  EXPECT_EQ(folded("y*sin(x - 3*pi/2) + cos(x)"), folded("y*cos(x) + cos(x)"));
  EXPECT_EQ(folded("sin(x + pi/6)"), folded("sin(pi/6 + x)"));
}

TEST(SpecialAngles, AreReadFromTheNextRightAngle) {
  Graph graph;
  const std::vector<std::string> names{"x"};
  const auto read = [&](const std::string& text) { return print(parse(text, graph, names), Form::text); };
  EXPECT_EQ(read("sin(x + pi/2)"), "cos(x)");
  EXPECT_EQ(read("cos(2*x - 3*pi/2)"), "-sin(2*x)");
  EXPECT_EQ(read("sin(pi/6)"), "sin(1/6*pi)");
  EXPECT_EQ(read("cos(x - pi/3)"), "cos(x - 1/3*pi)");
}

}  // namespace
}  // namespace qdot
