#include "api/about/agreement.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"

namespace qdot::api {
namespace {

/// Whether the sheet agrees that prints `value` where the answer has `found`, for l = 2 and g = 8.
bool agrees_with(const Json& value, const Json& found) {
  const Json answer{{"request", {{"parameters", {{"l", 2.0}, {"g", 8.0}}}}}, {"x", found}};
  return agrees(Json::array({{{"at", "/x"}, {"value", value}}}), answer);
}

TEST(Agreement, ADecimalHoldsToHalfAUnitOfItsLastDigit) {
  EXPECT_TRUE(agrees_with("0.9622", 0.96223333));
  EXPECT_FALSE(agrees_with("0.9622", 0.96226));
  EXPECT_FALSE(agrees_with("-0.9622", 0.9622));
}

TEST(Agreement, OtherNumbersAreExpressionsOfTheParameters) {
  EXPECT_TRUE(agrees_with("60", 60.00000000000001));
  EXPECT_FALSE(agrees_with("60", 60.4));
  EXPECT_TRUE(agrees_with("sqrt(g/l)", 2.0));
  EXPECT_FALSE(agrees_with("sqrt(2*g/l)", 2.0));
}

TEST(Agreement, ANumberMaySatisfyAnEquationInItsName) {
  EXPECT_TRUE(agrees_with("x^2 - 5/2*x + 1 = 0", 0.5));
  EXPECT_TRUE(agrees_with("x^2 + 1 = 5/2*x", 2.0));
  EXPECT_FALSE(agrees_with("x^2 - 5/2*x + 1 = 0", 0.50001));
}

TEST(Agreement, ExpressionsMayBeWrittenInAnyWay) {
  EXPECT_TRUE(agrees_with("sin(q)^2*m + m*cos(q)^2", "m"));
  EXPECT_FALSE(agrees_with("m*q_dot^2/2", "m*q_dot^2"));
  EXPECT_FALSE(agrees_with("m*sin(q)", "m*q")) << "nearly equal where q is small";
}

TEST(Agreement, EquationsMayDifferByAFactorFreeOfAccelerations) {
  EXPECT_TRUE(agrees_with("m*l^2*q_ddot = -m*g*l*sin(q)", "l*q_ddot + g*sin(q) = 0"));
  EXPECT_FALSE(agrees_with("m*l^2*q_ddot = m*g*l*sin(q)", "l*q_ddot + g*sin(q) = 0")) << "the sign";
  EXPECT_FALSE(agrees_with("q_ddot*(q_ddot + 1) = 0", "q_ddot = 0")) << "it has a second solution";
  EXPECT_FALSE(agrees_with("0 = 0", "q_ddot = 0"));
  EXPECT_FALSE(agrees_with("a*x_ddot + b*y_ddot = 0", "a*x_ddot - b*y_ddot = 0"));
}

TEST(Agreement, NamesArePrintedInTheirOrder) {
  EXPECT_TRUE(agrees_with({"mu", "gamma"}, {{"mu", "m/M"}, {"gamma", "gamma"}}));
  EXPECT_FALSE(agrees_with({"mu", "gamma"}, {{"mu", "m/M"}}));
  EXPECT_TRUE(agrees_with({"theta", "phi"}, Json{"theta", "phi"}));
}

/// The sheet's (62) has 35/3 where its own inertias give 53/3, and a wrong sign; physics tells which is
/// right.
TEST(Agreement, TheSheetsSlipsAreFoundAndItsCorrectionHolds) {
  const char* derived =
      "3*l*(110/9*theta_ddot + Omega^2*(cos(2*theta) - 53/9*sin(2*theta))) + g*(15*sin(theta) - cos(theta)) "
      "= "
      "0";
  const auto printed = [](const std::string& first, const std::string& second) {
    return "55/3*theta_ddot - " + first + "*Omega^2*sin(theta)*cos(theta) " + second +
           "*Omega^2*(sin(theta)^2 - cos(theta)^2) = -sqrt(226)/2*g/l*sin(theta - atan(1/15))";
  };
  EXPECT_FALSE(agrees_with(printed("35/3", "+ 3/2"), derived));
  EXPECT_FALSE(agrees_with(printed("53/3", "+ 3/2"), derived));
  EXPECT_TRUE(agrees_with(printed("53/3", "- 3/2"), derived));
}

TEST(Agreement, WhatCannotBeReadOrFoundIsAMistakeOfTheData) {
  EXPECT_THROW((void)agrees_with("2*(", 1.0), Error);
  EXPECT_THROW((void)agrees_with("k", 1.0), Error) << "no parameter of the request";
  EXPECT_THROW((void)agrees(Json::array({{{"at", "/y"}, {"value", "1"}}}), Json::object()), Json::exception);
}

}  // namespace
}  // namespace qdot::api
