// The number that makes a position an equilibrium, against closed forms and against the search of equilibria.

#include "core/steady/solve_for.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/steady/equilibria.hpp"
#include "tests/support/random.hpp"
#include "tests/support/scenes.hpp"

namespace qdot {
namespace {

constexpr double principal = 0.08410338592854305747;  // theta_p of the L-bar
constexpr double alpha = 0.06656816377582380820;
constexpr double half_pi = std::numbers::pi / 2;

Solution solved(const std::string& system, const std::string& unknown, const Values& given) {
  const auto model = test::model_of(system);
  const Dynamics dynamics(model);
  const std::vector<double> parameters = parameter_values(*model, given);
  return solve_for(dynamics, parameters, initial_state(*model, parameters, given), unknown);
}

TEST(SolveFor, TheLBarsSpinIsItsClosedFormOrIsNotReal) {
  test::Random random(1);
  for (int i = 0; i < 100; ++i) {
    const double g = random.real(1, 20), l = random.real(0.2, 2), theta = random.real(-3, 3);
    const Solution solution = solved("rotating_l_bar", "Omega", {{"g", g}, {"l", l}, {"theta", theta}});
    const long double t = theta;
    const long double square = 3 * (g / static_cast<long double>(l)) * (15 * std::sin(t) - std::cos(t)) /
                               (53 * std::sin(2 * t) - 9 * std::cos(2 * t));
    if (square < 0) {
      EXPECT_TRUE(solution.values.empty());
      EXPECT_NE(solution.reason.find("No real Omega"), std::string::npos);
      continue;
    }
    ASSERT_EQ(solution.values.size(), 2U);
    EXPECT_LE(std::abs(solution.values[0].value - std::sqrt(square)), solution.values[0].error * 1.01L);
    EXPECT_LT(solution.values[0].error, 1e-11 * solution.values[0].value);
    EXPECT_EQ(solution.values[1].value, -solution.values[0].value);
  }
}

TEST(SolveFor, ItsValueGivesTheEquilibriumBack) {
  test::Random random(2);
  const auto model = test::model_of("free_spin_pendulum");
  const Dynamics dynamics(model);
  for (int i = 0; i < 40; ++i) {
    Values given{{"g", random.real(1, 20)}, {"l", random.real(0.2, 2)}, {"theta", random.real(0.05, 1.5)}};
    const Solution solution = solved("free_spin_pendulum", "psi_dot", given);
    ASSERT_EQ(solution.values.size(), 2U);
    EXPECT_EQ(solution.values[0].stability.stability, Stability::stable);
    given["psi_dot"] = solution.values[0].value;
    const std::vector<double> parameters = parameter_values(*model, given);
    const Equilibria found = equilibria(dynamics, parameters, initial_state(*model, parameters, given));
    double nearest = 1;
    for (const SteadyState& state : found.states)
      nearest = std::min(nearest, std::abs(state.y[0] - given["theta"]));
    EXPECT_LT(nearest, 1e-13);
  }
}

TEST(SolveFor, SteadyConeOfTheSpinningArm) {
  const Solution solution =
      solved("free_spin_pendulum", "psi_dot", {{"m", 1.7}, {"l", 0.9}, {"g", 9.81}, {"theta", 0.6}});
  ASSERT_FALSE(solution.values.empty());
  EXPECT_NEAR(solution.values[0].value, 2.6465666375548724, 3e-15);
  EXPECT_NEAR(std::sqrt(solution.values[0].stability.rate2->middle()), 5.2459815900702775, 1e-14);
}

TEST(SolveFor, RangesOfTheLBarAreThoseOfTheory) {
  const Solution solution = solved("rotating_l_bar", "Omega", {{"theta", 0.3}});
  ASSERT_TRUE(solution.ranges);
  ASSERT_EQ(solution.ranges->size(), 3U);
  const double pi = std::numbers::pi;
  const double expected[3][2] = {
      {alpha - pi, principal - pi}, {principal - half_pi, alpha}, {principal, principal + half_pi}};
  const bool included[3][2] = {{true, false}, {false, true}, {false, false}};
  for (std::size_t i = 0; i < 3; ++i) {
    const SolvableRange& range = (*solution.ranges)[i];
    EXPECT_NEAR(range.from, expected[i][0], 2e-15);
    EXPECT_NEAR(range.to, expected[i][1], 2e-15);
    EXPECT_EQ(range.from_included, included[i][0]);
    EXPECT_EQ(range.to_included, included[i][1]);
  }
}

TEST(SolveFor, WhereTheSpinWouldBeInfiniteThereIsNone) {
  const Solution at = solved("rotating_l_bar", "Omega", {{"theta", principal}});
  EXPECT_TRUE(at.values.empty());
  EXPECT_NE(at.reason.find("No finite Omega"), std::string::npos);
  const Solution beside = solved("rotating_l_bar", "Omega", {{"theta", principal + 1e-9}});
  ASSERT_EQ(beside.values.size(), 2U);
  EXPECT_GT(beside.values[0].value, 1e4);
  EXPECT_LT(beside.values[0].error, 1e-6 * beside.values[0].value);
  EXPECT_TRUE(solved("rotating_l_bar", "Omega", {{"theta", principal - 1e-9}}).values.empty());
}

TEST(SolveFor, SeveralForcesMustVanishTogether) {
  const Values scene{{"m", 0.5}, {"l0", 0.37}, {"g", 9.81}, {"l", 0.5}};
  const auto stiffness = [&](double theta) {
    Values given = scene;
    given["theta"] = theta;
    return solved("spring_pendulum", "k", given);
  };
  ASSERT_EQ(stiffness(0).values.size(), 1U);
  EXPECT_NEAR(stiffness(0).values[0].value, 0.5 * 9.81 / 0.13, 1e-12);
  EXPECT_TRUE(stiffness(0.3).values.empty());
  EXPECT_NE(stiffness(0.3).reason.find("theta is not in balance"), std::string::npos);
  EXPECT_TRUE(stiffness(std::numbers::pi).values.empty());  // hanging upwards it would have to push
  EXPECT_NE(stiffness(std::numbers::pi).reason.find("outside its domain"), std::string::npos);
}

TEST(SolveFor, AParameterThatDoesNotMatterIsSaid) {
  EXPECT_NE(solved("whirling_pendulum", "Omega", {{"theta", 0}}).reason.find("Every value"),
            std::string::npos);
  EXPECT_NE(solved("whirling_pendulum", "R", {{"theta", 0.5}}).reason.find("whatever R is"),
            std::string::npos);
}

TEST(SolveFor, AnAngleAmongTheParametersIsSearchedOverATurn) {
  const Solution solution = solved("compass_walker", "gamma", {{"m", 0.1}, {"theta", 0.01}, {"phi", 0}});
  ASSERT_FALSE(solution.values.empty());
  EXPECT_NEAR(solution.values[0].value, 0.01, 1e-16);
}

TEST(SolveFor, NamesAreTheParametersAndTheSpins) {
  const auto model = test::model_of("free_spin_pendulum");
  const Dynamics dynamics(model);
  EXPECT_EQ(solvable_names(dynamics, parameter_values(*model, {})),
            (std::vector<std::string>{"m", "l", "g", "psi_dot"}));
}

}  // namespace
}  // namespace qdot
