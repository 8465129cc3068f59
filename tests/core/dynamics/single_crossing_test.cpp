// Whether functions of x and x' pass zero once while x goes through a box at about 2 m/s.

#include "core/dynamics/single_crossing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/compile/taylor/formula.hpp"

namespace qdot {
namespace {

bool passes_once(const char* formula, double from, double to) {
  const auto once =
      single_crossing_of(std::make_shared<const CompiledFunction>(test::function_of(formula)), {});
  const std::vector<Interval> y{{from, to}, {1.99, 2.01}}, rates{y[1], {-1, 1}};
  return once({.t = {0, (to - from) / 2}, .y = y, .rates = rates});
}

TEST(SingleCrossing, IsToldBySlopesAlongTheMotion) {
  EXPECT_TRUE(passes_once("q - 0.5", 0.4, 0.6));
  EXPECT_TRUE(passes_once("exp(q) - q - 1.2", 0.4, 0.6));
  EXPECT_TRUE(passes_once("q_dot*(q - 0.5)", 0.4, 0.6));
  EXPECT_FALSE(passes_once("(q - 0.5)^3", 0.4, 0.6));
  EXPECT_FALSE(passes_once("(q - 0.45)*(q - 0.5)", 0.4, 0.6));
  EXPECT_FALSE(passes_once("q_dot - 2", 0.4, 0.6));
}

TEST(SingleCrossing, IsToldWhereItJumpsOrBendsOnce) {
  EXPECT_TRUE(passes_once("sign(q - 0.5)", 0.4, 0.6));
  EXPECT_TRUE(passes_once("sign(q - 0.5) + 0.3*q_dot", 0.4, 0.6));
  EXPECT_TRUE(passes_once("3*(q - 0.5) + abs(q - 0.5)", 0.4, 0.6));
  EXPECT_TRUE(passes_once("sign(q - 0.9)*(q - 0.5)", 0.4, 0.6));
}

TEST(SingleCrossing, IsNotToldWhereItMayJumpOrBendAgain) {
  EXPECT_FALSE(passes_once("sign((q - 0.45)*(q - 0.5)*(q - 0.55))", 0.4, 0.6));
  EXPECT_FALSE(passes_once("sign(q - 0.45)*sign(q - 0.5)*sign(q - 0.55)", 0.4, 0.6));
  EXPECT_FALSE(passes_once("q - 0.5 - 0.05*sign(q - 0.5)", 0.4, 0.6));  // up, down, and up again
  EXPECT_FALSE(passes_once("sign(q - 0.5)*(q - 0.45)", 0.4, 0.6));
  EXPECT_FALSE(passes_once("0.5*(q - 0.5) - abs(q - 0.5)", 0.4, 0.6));
  EXPECT_FALSE(passes_once("sign(q_dot - 2)", 0.4, 0.6));
}

}  // namespace
}  // namespace qdot
