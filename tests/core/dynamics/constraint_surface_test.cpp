// Projection onto constraints, and initial states that obey them.

#include "core/dynamics/constraint_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/dynamics/consistent_state.hpp"

namespace qdot {
namespace {

/// A point on a circle that rolls a wheel along x, theta by its angle.
Scene wheel_on_circle() {
  Scene scene;
  scene.name = "wheel";
  scene.parameters = {
      {"m", "kg", "2", {}, "", ""}, {"l", "m", "1", {}, "", ""}, {"r", "m", "0.25", {}, "", ""}};
  scene.coordinates = {{"x", "m", "0.6", "0", "", {}, "", ""},
                       {"y", "m", "0.8", "0", "", {}, "", ""},
                       {"theta", "rad", "0", "0", "", {}, "", ""}};
  scene.lagrangian = "m*(x_dot^2 + y_dot^2 + r^2*theta_dot^2)/2";
  scene.constraints = {{"circle", "x^2 + y^2 - l^2", "", ""}, {"rolling", "x_dot - r*theta_dot", "", ""}};
  return scene;
}

TEST(ConstrainedStates, AreReachedQuadratically) {
  const Dynamics dynamics(build_model(wheel_on_circle()));
  const std::vector<double> parameters{2, 1, 0.25};
  ConstrainedStates states(*dynamics.constraint_surface(), parameters);
  std::vector<double> y{0.6 + 1e-4, 0.8, 0.1, 0.8, -0.6 + 1e-3, 3.2};
  ASSERT_TRUE(states.project(0, y));
  ASSERT_TRUE(states.evaluate(0, y));
  EXPECT_LT(std::abs(states.residuals()[0]), 1e-8);
  ASSERT_TRUE(states.project(0, y));
  ASSERT_TRUE(states.evaluate(0, y));
  for (const double residual : states.residuals()) EXPECT_LT(std::abs(residual), 4e-16);
  EXPECT_NEAR(y[3], 0.25 * y[5], 4e-16);
  EXPECT_EQ(y[2], 0.1) << "what no position constraint speaks of stays";
}

TEST(ConstrainedStates, HaveNoStepWhereSlopesVanish) {
  const Dynamics dynamics(build_model(wheel_on_circle()));
  ConstrainedStates states(*dynamics.constraint_surface(), std::vector<double>{2, 1, 0.25});
  std::vector<double> y(6);
  EXPECT_FALSE(states.project(0, y));
}

TEST(ConsistentState, HasTwiceTheDigits) {
  const Dynamics dynamics(build_model(wheel_on_circle()));
  const Reals parameters = parameter_values(dynamics.model(), {});
  const Reals typed = initial_state(dynamics.model(), parameters, {{"x", 0.28}, {"y", 0.96}});
  const Reals y = consistent_state(dynamics, parameters, 0, typed, std::vector<bool>(6));
  const auto exact = [&](std::size_t i) { return y.exact(i).double_double(); };
  const DoubleDouble residual = exact(0) * exact(0) + exact(1) * exact(1) - DoubleDouble(1);
  EXPECT_LT(std::abs(residual.value()), 1e-30);
  const long double x = 0.28, y_typed = 0.96;
  EXPECT_GT(std::abs(x * x + y_typed * y_typed - 1), 1e-19L) << "the doubles are off";
}

TEST(ConsistentState, KeepsWhatIsGiven) {
  const Dynamics dynamics(build_model(wheel_on_circle()));
  const Reals parameters = parameter_values(dynamics.model(), {});
  const Reals typed = initial_state(dynamics.model(), parameters, {{"x", 0.28}, {"theta_dot", 4}});
  try {
    (void)consistent_state(dynamics, parameters, 0, typed, {true, false, false, false, false, true});
    FAIL() << "0.28^2 + 0.8^2 is not 1";
  } catch (const InconsistentState& error) {
    ASSERT_EQ(error.nearest().size(), 6u);
    EXPECT_EQ(error.nearest()[0], (std::pair<std::string, double>{"x", 0.28}));
    EXPECT_NEAR(error.nearest()[1].second, 0.96, 1e-15);
    EXPECT_EQ(error.nearest()[5].second, 4);
    EXPECT_NEAR(error.nearest()[3].second, 1, 1e-15);
    EXPECT_NEAR(error.nearest()[4].second, -0.28 / 0.96, 1e-15);
  }
}

bool is_determined(const std::string& constraint, double x, double y) {
  Scene scene;
  scene.name = "wire";
  scene.without_units = true;
  scene.coordinates = {{"x", "1", "0", "0", "", {}, "", ""}, {"y", "1", "0", "0", "", {}, "", ""}};
  scene.lagrangian = "(x_dot^2 + y_dot^2)/2 - y";
  scene.constraints = {{"wire", constraint, "", ""}};
  const Dynamics dynamics(build_model(scene));
  const Reals parameters = parameter_values(dynamics.model(), {});
  const Reals typed = initial_state(dynamics.model(), parameters, {{"x", x}, {"y", y}});
  try {
    (void)consistent_state(dynamics, parameters, 0, typed, std::vector<bool>(4));
    return true;
  } catch (const Error&) {
    return false;
  }
}

TEST(ConsistentState, IsDeterminedWhereTheConstraintHasASlope) {
  EXPECT_TRUE(is_determined("y - 1 + cos(x)", 0, 0)) << "the terms are 1, the coordinates 0";
  EXPECT_TRUE(is_determined("sqrt(x^2 + (y - 1)^2) - 1", 0, 0));
  EXPECT_FALSE(is_determined("(x - 1)^2", 1, 0));
  EXPECT_FALSE(is_determined("(x - 1)^2", 1 + 1e-7, 0)) << "0 within what typed decimals leave";
  EXPECT_FALSE(is_determined("(x^2 - 2)^2", 1.41421356237, 0));
  EXPECT_FALSE(is_determined("1 - cos(x)", 0, 0));
  EXPECT_FALSE(is_determined("1 - cos(x)", 1e-7, 0));
  EXPECT_FALSE(is_determined("(x - 1)*(y - 1)", 1, 1));
}

}  // namespace
}  // namespace qdot
