// Critical values against closed forms; branches against the equilibria they join.

#include "core/steady/bifurcations.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random.hpp"
#include "tests/support/scenes.hpp"

namespace qdot {
namespace {

constexpr double fold_square = 0.46257442562035035824;  // of the L-bar, in g/l
constexpr double fold_angle = 0.33829126264813825728;

Bifurcations of(const std::string& system, const std::string& parameter, double from, double to,
                const Values& given = {}) {
  const auto model = test::model_of(system);
  const Dynamics dynamics(model);
  const std::vector<double> parameters = parameter_values(*model, given);
  std::size_t index = 0;
  while (model->scene.parameters[index].name != parameter) ++index;
  return bifurcations(dynamics, parameters, initial_state(*model, parameters, given), index, from, to);
}

void expect_critical(const CriticalValue& c, BifurcationKind kind, double value, double angle) {
  EXPECT_EQ(c.kind, kind);
  EXPECT_TRUE(c.proven);
  EXPECT_LE(std::abs(c.value - value), c.error + 4e-16 * std::abs(value));
  EXPECT_LT(c.error, 1e-13 * std::abs(value));
  EXPECT_NEAR(c.y[0], angle, 1e-13);
}

TEST(CriticalValues, TheWhirlingPendulumHasAPitchforkOnEitherSide) {
  test::Random random(1);
  for (int i = 0; i < 20; ++i) {
    const double g = random.real(1, 20), l = random.real(0.2, 2);
    const double critical = std::sqrt(g / l);
    const Bifurcations found = of("whirling_pendulum", "Omega", -12, 12, {{"g", g}, {"l", l}});
    ASSERT_TRUE(found.complete);
    ASSERT_EQ(found.critical.size(), 2U);
    expect_critical(found.critical[0], BifurcationKind::pitchfork, -critical, 0);
    expect_critical(found.critical[1], BifurcationKind::pitchfork, critical, 0);
    EXPECT_EQ(found.branches.size(), 6U);
  }
}

TEST(CriticalValues, TheLBarHasASaddleNode) {
  test::Random random(2);
  for (int i = 0; i < 20; ++i) {
    const double g = random.real(1, 20), l = random.real(0.2, 2);
    const Bifurcations found = of("rotating_l_bar", "Omega", 0, 10, {{"g", g}, {"l", l}});
    ASSERT_TRUE(found.complete);
    ASSERT_EQ(found.critical.size(), 1U);
    expect_critical(found.critical[0], BifurcationKind::saddle_node, std::sqrt(fold_square * g / l),
                    fold_angle);
  }
}

TEST(CriticalValues, OfOtherParametersAreTheSameCurve) {
  const Bifurcations gravity = of("whirling_pendulum", "g", 0, 30, {{"l", 0.5}, {"Omega", 6}});
  ASSERT_EQ(gravity.critical.size(), 1U);
  expect_critical(gravity.critical[0], BifurcationKind::pitchfork, 18, 0);
  const Bifurcations length = of("rotating_l_bar", "l", 0.01, 3, {{"Omega", 6}});
  ASSERT_EQ(length.critical.size(), 1U);
  expect_critical(length.critical[0], BifurcationKind::saddle_node, fold_square * 9.81 / 36, fold_angle);
}

/// Two equal pendula on one another in a plane that turns: by symmetry no force has factors, and hanging
/// straight loses its stability at Omega^2 = (2 - sqrt 2) g/l.
Scene rotating_double_pendulum() {
  Scene scene = test::scene_of("whirling_pendulum");
  std::erase_if(scene.parameters, [](const Parameter& p) { return p.name == "R"; });
  Coordinate second = scene.coordinates[0];
  second.name = "phi";
  scene.coordinates.push_back(second);
  const std::string reach = "(l*sin(theta) + l*sin(phi))";
  const Position upper{"", {"l*sin(theta)*cos(Omega*t)", "l*sin(theta)*sin(Omega*t)", "-l*cos(theta)"}};
  const Position lower{"", {reach + "*cos(Omega*t)", reach + "*sin(Omega*t)", "-l*cos(theta) - l*cos(phi)"}};
  scene.points.clear();
  scene.lines.clear();
  scene.valid_while.clear();
  scene.bodies = {Particle{"upper", "m", upper}, Particle{"lower", "m", lower}};
  scene.gravity = {"0", "0", "-g"};
  return scene;
}

TEST(CriticalValues, WhereNoForceHasFactorsAreProvenAtPositionsThatStay) {
  const auto model = build_model(rotating_double_pendulum());
  const Dynamics dynamics(model);
  const std::vector<double> parameters = parameter_values(*model, {{"l", 1}, {"g", 9.81}});
  const std::vector<double> y = initial_state(*model, parameters, {});
  std::size_t index = 0;
  while (model->scene.parameters[index].name != "Omega") ++index;
  const Bifurcations found = bifurcations(dynamics, parameters, y, index, 0, 4);
  EXPECT_FALSE(found.complete);
  ASSERT_FALSE(found.critical.empty());
  const CriticalValue& first = found.critical[0];
  EXPECT_EQ(first.kind, BifurcationKind::pitchfork);
  EXPECT_TRUE(first.proven);
  EXPECT_LE(std::abs(first.value - std::sqrt((2 - std::sqrt(2.0)) * 9.81)), first.error);
  EXPECT_LT(first.error, 1e-9);
}

TEST(CriticalValues, AtAnEndOfTheRangeCount) {
  const Values scene{{"g", 9}, {"l", 1}};
  for (const auto& [from, to] : {std::pair(3.0, 10.0), std::pair(0.0, 3.0)}) {
    const Bifurcations found = of("whirling_pendulum", "Omega", from, to, scene);
    ASSERT_EQ(found.critical.size(), 1U);
    expect_critical(found.critical[0], BifurcationKind::pitchfork, 3, 0);
  }
  EXPECT_TRUE(of("whirling_pendulum", "Omega", 0, 2.99, scene).critical.empty());
}

TEST(CriticalValues, ThereAreNoneWhereNothingDependsOnTheParameter) {
  const Bifurcations found = of("whirling_pendulum", "R", 0, 1);
  EXPECT_TRUE(found.critical.empty());
  EXPECT_NE(found.reason.find("No force at rest depends on R"), std::string::npos);
  EXPECT_EQ(found.branches.size(), 4U);
}

TEST(CriticalValues, WhereAForceVanishesEverywhereNothingIsClaimed) {
  const Bifurcations found = of("orbiting_pendulum", "omega0", -1, 3);
  EXPECT_TRUE(found.critical.empty());
  EXPECT_EQ(found.degenerate, (std::vector<double>{0}));
}

TEST(Branches, OfThePitchforkBeginAtItAndFollowTheArcCosine) {
  const Bifurcations found = of("whirling_pendulum", "Omega", 0, 10, {{"g", 9}, {"l", 1}});
  ASSERT_EQ(found.branches.size(), 4U);
  int arms = 0;
  for (const EquilibriumBranch& branch : found.branches) {
    if (branch.parameter.front() == 0) continue;
    ++arms;
    EXPECT_NEAR(branch.parameter.front(), 3, 1e-14);
    EXPECT_EQ(branch.x.front()[0], 0);
    for (std::size_t i = 1; i < branch.parameter.size(); ++i) {
      const double omega = branch.parameter[i];
      EXPECT_NEAR(std::abs(branch.x[i][0]), std::acos(9 / (omega * omega)), 1e-10);
      EXPECT_EQ(branch.stability[i], Stability::stable);
      EXPECT_GE(branch.x[i][0] * branch.x[i - 1][0], 0);
    }
  }
  EXPECT_EQ(arms, 2);
}

TEST(Branches, OfTheFoldMeetAtIt) {
  const Bifurcations found = of("rotating_l_bar", "Omega", 0, 10, {{"l", 0.5}});
  ASSERT_EQ(found.branches.size(), 4U);
  std::vector<Stability> beside;
  for (const EquilibriumBranch& branch : found.branches) {
    if (branch.parameter.front() == 0) continue;
    EXPECT_NEAR(branch.x.front()[0], fold_angle, 1e-13);
    beside.push_back(branch.stability[1]);
  }
  ASSERT_EQ(beside.size(), 2U);
  EXPECT_NE(beside[0], beside[1]);
}

}  // namespace
}  // namespace qdot
