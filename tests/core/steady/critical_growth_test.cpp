// Values of a parameter at which oscillations begin to grow, against closed forms.

#include "core/steady/critical_growth.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/steady/bifurcations.hpp"
#include "tests/support/scenes.hpp"

namespace qdot::critical_growth_test {
namespace {

Bifurcations of(const std::string& json, const std::string& parameter, double from, double to,
                const Values& given = {}) {
  const auto model = test::model_written(json);
  const Dynamics dynamics(model);
  const Reals parameters = parameter_values(*model, given);
  std::size_t index = 0;
  while (model->scene.parameters[index].name != parameter) ++index;
  return bifurcations(dynamics, parameters, initial_state(*model, parameters, given), index, from, to);
}

void expect_growth(const Bifurcations& found, BifurcationKind kind, double value, double omega) {
  EXPECT_TRUE(found.complete) << found.reason;
  ASSERT_EQ(found.critical.size(), 1U);
  const CriticalValue& c = found.critical[0];
  EXPECT_EQ(c.kind, kind);
  EXPECT_TRUE(c.proven);
  EXPECT_LE(std::abs(c.value - value), c.error + 4e-16 * std::abs(value));
  EXPECT_LE(std::abs(c.omega - omega), c.omega_error + 4e-16 * omega);
  EXPECT_LT(c.error, 1e-13);
}

/// Two links of length l with springs c and masses 2 m and m, and a load P along the last link (Ziegler,
/// Principles of Structural Stability, 2nd ed., 4); dampers d beside the springs.
const std::string ziegler = R"json({"name": "ziegler", "units": "none",
  "parameters": [{"name": "m", "default": "1"}, {"name": "l", "default": "1"}, {"name": "c", "default": "1"},
                 {"name": "P", "default": "1"}, {"name": "d", "default": "0"}],
  "coordinates": [{"name": "a", "initial": "0"}, {"name": "b", "initial": "0"}],
  "bodies": [{"kind": "particle", "mass": "2*m", "position": ["l*cos(a)", "l*sin(a)"]},
             {"kind": "particle", "mass": "m", "position": ["l*cos(a) + l*cos(b)", "l*sin(a) + l*sin(b)"]}],
  "springs": [{"stiffness": "c", "angle": "a"}, {"stiffness": "c", "angle": "b - a"}],
  "dampers": [{"coefficient": "d", "angle": "a"}, {"coefficient": "d", "angle": "b - a"}],
  "forces": [{"vector": ["-P*cos(b)", "-P*sin(b)"],
              "point": ["l*cos(a) + l*cos(b)", "l*sin(a) + l*sin(b)"]}]})json";

TEST(CriticalGrowth, ZieglersPendulumFluttersWhereTwoFrequenciesMeet) {
  for (const double l : {1.0, 0.5}) {
    const double value = (7 - 2 * std::sqrt(2.0)) / (2 * l), omega = std::pow(2, -0.25) / l;
    expect_growth(of(ziegler, "P", 0, 4 / l, {{"l", l}}), BifurcationKind::flutter, value, omega);
  }
}

TEST(CriticalGrowth, DampingMakesItFlutterAtASmallerLoad) {
  const double d = 0.1;
  expect_growth(of(ziegler, "P", 0, 4, {{"d", d}}), BifurcationKind::hopf, 41.0 / 28 + d * d / 2,
                std::sqrt(2.0 / 7));
}

std::string oscillator(const std::string& lagrangian, const std::string& along_x,
                       const std::string& along_y) {
  return R"({"name": "plane", "units": "none", "parameters": [{"name": "p", "default": "1"}],
    "coordinates": [{"name": "x", "initial": "0"}, {"name": "y", "initial": "0"}],
    "lagrangian": ")" +
         lagrangian + R"(", "forces": [{"value": ")" + along_x + R"(", "along": "x"}, {"value": ")" +
         along_y + R"(", "along": "y"}]})";
}

TEST(CriticalGrowth, ASleepingTopFallsBelowItsSpin) {
  // Near the upright: A x'' = k x - p y', A y'' = k y + p x', stable for p^2 > 4 A k (Goldstein, 5.7).
  const std::string top =
      oscillator("(x_dot^2 + y_dot^2)/2 + p/2*(x*y_dot - y*x_dot) + 9/8*(x^2 + y^2)", "0", "0");
  expect_growth(of(top, "p", 0.5, 5), BifurcationKind::flutter, 3, 1.5);
}

TEST(CriticalGrowth, AShaftWithDampingOfItsOwnWhirlsAboveASpeed) {
  // Outer damping 1/10, inner 1/5, omega = 2: whirls where inner spin exceeds (0.1 + 0.2)/0.2 omega.
  const std::string shaft =
      oscillator("(x_dot^2 + y_dot^2)/2 - 2*(x^2 + y^2)", "-3/10*x_dot - p*y/5", "-3/10*y_dot + p*x/5");
  expect_growth(of(shaft, "p", 0, 10), BifurcationKind::hopf, 3, 2);
}

/// A hilltop, or a well, beneath a gyroscopic force, with damping p: s^2 + p s +- 2 i w s - a = 0.
Bifurcations damped(const std::string& stiffness, double from, double to) {
  const std::string lagrangian =
      "(x_dot^2 + y_dot^2)/2 + 2*(x*y_dot - y*x_dot) + " + stiffness + "*(x^2 + y^2)/2";
  return of(oscillator(lagrangian, "-p*x_dot", "-p*y_dot"), "p", from, to);
}

TEST(CriticalGrowth, PairsThatCrossTogetherAreToldWithoutAFrequencyTheyDoNotShare) {
  for (const std::string stiffness : {"1", "(-1)"}) {  // omega = 2 +- sqrt(3), or sqrt(5) +- 2
    const Bifurcations found = damped(stiffness, -1, 1.5);
    EXPECT_TRUE(found.complete) << found.reason;
    ASSERT_EQ(found.critical.size(), 1U);
    EXPECT_EQ(found.critical[0].kind, BifurcationKind::unresolved);
    EXPECT_LE(std::abs(found.critical[0].value), found.critical[0].error);
    EXPECT_EQ(found.critical[0].omega, 0);
  }
}

TEST(CriticalGrowth, OfFourCoordinatesIsSaidNotToBeSearched) {
  const std::string four =
      R"json({"name": "four", "units": "none", "parameters": [{"name": "p", "default": "1"}],
    "coordinates": [{"name": "x", "initial": "0"}, {"name": "y", "initial": "0"}, {"name": "u", "initial": "0"},
                    {"name": "v", "initial": "0"}],
    "lagrangian": "(x_dot^2 + y_dot^2 + u_dot^2 + v_dot^2)/2 + 2*(x*y_dot - y*x_dot) + (x^2 + y^2 - u^2 - v^2)/2",
    "forces": [{"value": "-p*x_dot", "along": "x"}, {"value": "-p*y_dot", "along": "y"}]})json";
  const Bifurcations found = of(four, "p", -1, 1.5);  // pairs cross at 0, and as many grow before as after
  EXPECT_FALSE(found.complete);
  EXPECT_FALSE(found.reason.empty());
}

/// n equal links, springs and masses with a load along the last one.
std::string follower_column(const std::vector<std::string>& angles) {
  std::string coordinates, bodies, springs, x, y;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const std::string comma = i == 0 ? "" : ", ", plus = i == 0 ? "" : " + ";
    coordinates += comma + R"json({"name": ")json" + angles[i] + R"json(", "initial": "0"})json";
    x += plus + "cos(" + angles[i] + ")";
    y += plus + "sin(" + angles[i] + ")";
    bodies +=
        comma + R"json({"kind": "particle", "mass": "1", "position": [")json" + x + "\", \"" + y + "\"]}";
    const std::string before = i == 0 ? "" : " - " + angles[i - 1];
    springs += comma + R"json({"stiffness": "1", "angle": ")json" + angles[i] + before + "\"}";
  }
  const std::string last = angles.back();
  return R"json({"name": "column", "units": "none", "parameters": [{"name": "P", "default": "1"}],
    "coordinates": [)json" +
         coordinates + R"json(], "bodies": [)json" + bodies + R"json(], "springs": [)json" + springs +
         R"json(], "forces": [{"vector": ["-P*cos()json" + last + R"json()", "-P*sin()json" + last +
         R"json()"], "point": [")json" + x + "\", \"" + y + "\"]}]}";
}

TEST(CriticalGrowth, OfThreeLinksIsFoundAlongTheCurveAndSaidToBeNotProven) {
  const Bifurcations found = of(follower_column({"a", "b", "c"}), "P", 0, 2);
  EXPECT_FALSE(found.complete);
  ASSERT_EQ(found.critical.size(), 1U);
  const CriticalValue& c = found.critical[0];
  EXPECT_EQ(c.kind, BifurcationKind::flutter);
  EXPECT_FALSE(c.proven);
  EXPECT_LE(std::abs(c.value - 1.1862872709454474), c.error + 3e-16);  // discriminant of the cubic, by mpmath
  EXPECT_LT(c.error, 1e-12);
}

TEST(CriticalGrowth, IsNoneWhereOppositeRealEigenvaluesPass) {
  const std::string saddle =
      oscillator("(x_dot^2 + y_dot^2)/2 + x^2/2 - y^2/2", "-(p - 1/2)*x_dot", "-y_dot");
  const Bifurcations found = of(saddle, "p", 0, 1);
  EXPECT_TRUE(found.complete);
  EXPECT_TRUE(found.critical.empty());
}

}  // namespace
}  // namespace qdot::critical_growth_test
