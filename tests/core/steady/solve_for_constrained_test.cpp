// The number that holds a position on the surface of constraints, against closed forms.

#include <gtest/gtest.h>

#include <cmath>

#include "core/steady/solve_for.hpp"
#include "tests/support/scenes.hpp"

namespace qdot::solve_for_constrained_test {
namespace {

Solution solved(const std::string& json, const std::string& unknown, const Values& given) {
  const auto model = test::model_written(json);
  const Dynamics dynamics(model);
  const Reals parameters = parameter_values(*model, given);
  return solve_for(dynamics, parameters, initial_state(*model, parameters, given), unknown);
}

void expect_value(const Solution& solution, std::size_t i, double value) {
  ASSERT_GT(solution.values.size(), i) << solution.reason;
  EXPECT_LE(std::abs(solution.values[i].value - value), solution.values[i].error + 4e-16 * std::abs(value));
  EXPECT_LT(solution.values[i].error, 1e-13 * std::abs(value));
}

/// A pendulum that swings about the vertical, in cylindrical coordinates on the surface r^2 + z^2 = l^2.
const std::string cone = R"json({"name": "cone", "units": "none",
  "parameters": [{"name": "m", "default": "1"}, {"name": "l", "default": "5"}, {"name": "g", "default": "10"}],
  "coordinates": [{"name": "r", "initial": "3"}, {"name": "psi", "initial": "0"}, {"name": "z", "initial": "-4"}],
  "bodies": [{"kind": "particle", "mass": "m", "position": ["r*cos(psi)", "r*sin(psi)", "z"]}],
  "gravity": ["0", "0", "-g"],
  "constraints": [{"name": "rod", "expression": "r^2 + z^2 - l^2"}]})json";

TEST(SolveForUnderConstraints, TheSpinOfAConeIsTheRootOfGravityOverItsHeight) {
  const Solution solution = solved(cone, "psi_dot", {});
  expect_value(solution, 0, std::sqrt(10.0 / 4));
  expect_value(solution, 1, -std::sqrt(10.0 / 4));
  EXPECT_EQ(solution.values[0].stability.stability, Stability::stable);
}

TEST(SolveForUnderConstraints, NoSpinHoldsItAboveItsPivot) {
  const Solution solution = solved(cone, "psi_dot", {{"z", 4}});
  EXPECT_TRUE(solution.values.empty());
  EXPECT_FALSE(solution.reason.empty());
}

/// A ladder on a smooth floor and a smooth wall, held by a horizontal force at its foot.
const std::string ladder = R"json({"name": "ladder", "units": "none",
  "parameters": [{"name": "m", "default": "2"}, {"name": "l", "default": "5"}, {"name": "g", "default": "10"},
                 {"name": "H", "default": "1"}],
  "coordinates": [{"name": "x", "initial": "3"}, {"name": "y", "initial": "4"}],
  "bodies": [{"kind": "rod", "mass": "m", "start": ["x", "0"], "end": ["0", "y"]}],
  "gravity": ["0", "-g"],
  "forces": [{"vector": ["-H", "0"], "point": ["x", "0"]}],
  "constraints": [{"name": "length", "expression": "x^2 + y^2 - l^2"}]})json";

TEST(SolveForUnderConstraints, AForceHoldsALadderWhoseHeightFallsAsItsFootSlides) {
  expect_value(solved(ladder, "H", {}), 0, 2 * 10 * 3 / (2 * 4.0));  // m g x/(2 y)
}

TEST(SolveForUnderConstraints, TheLengthOfTheLadderIsNoneOfItsForces) {
  const Solution solution = solved(ladder, "l", {{"H", 7.5}});
  expect_value(solution, 0, 5);  // the constraint itself
}

}  // namespace
}  // namespace qdot::solve_for_constrained_test
