// Small motions: reference values, closed forms, a simulated oscillation's frequency, extremes, and scenes
// with gyroscopic terms and damping.

#include "core/steady/modes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/core/steady/modes_support.hpp"
#include "tests/support/files.hpp"
#include "tests/support/motions.hpp"
#include "tests/support/random.hpp"

namespace qdot::modes_test {
namespace {

using api::Json;
using std::numbers::pi;

using test::expect_omega, test::expect_shape, test::kinds, test::modes_of, test::promised, test::tight;

TEST(Modes, AgreeWithTheReferenceValues) {
  int count = 0;
  for (const std::string& system : test::practice_systems()) {
    const auto model = test::model_of(system);
    const Json file = test::json_file("tests/reference/" + system + ".json");
    for (const Json& json : file.at("cases")) {
      if (json.at("quantity") != "modes") continue;
      ++count;
      const Modes found = modes_of(system, json.at("parameters").get<Values>());
      const Json& expected = json.at("expected");
      ASSERT_EQ(found.modes.size(), expected.at("omega").size()) << json.at("id");
      EXPECT_EQ(found.stability, Stability::stable);
      for (std::size_t i = 0; i < found.modes.size(); ++i) {
        expect_omega(found.modes[i], expected.at("omega")[i]);
        std::vector<double> shape;
        for (const Coordinate& q : model->scene.coordinates)
          shape.push_back(expected.at("mode_shapes")[i].at(q.name));
        expect_shape(found.modes[i], shape);
      }
      for (std::size_t i = 0; i < model->degrees_of_freedom(); ++i) {
        const double q = expected.at("equilibrium").at(model->scene.coordinates[i].name);
        EXPECT_NEAR(found.y[i], q, promised * std::abs(q));
        ASSERT_TRUE(found.y_error[i]);
        EXPECT_LE(*found.y_error[i], tight);
      }
    }
  }
  EXPECT_EQ(count, 5);
}

TEST(Modes, OfTheSheetsCartAreInAndOutOfStep) {
  const double l = 0.4, g = 9.81;
  const Modes found = modes_of("cart_pendulum", {{"l", l}, {"g", g}});
  expect_omega(found.modes[0], std::sqrt(g / (2 * l)));
  expect_omega(found.modes[1], std::sqrt(2 * g / l));
  expect_shape(found.modes[0], {1, 1 / l});
  expect_shape(found.modes[1], {1, -2 / l});
  EXPECT_TRUE(found.gyroscopic.empty());
  EXPECT_TRUE(found.damping.empty());
  EXPECT_EQ(found.y, (std::vector<double>{0, 0, 0, 0}));
}

TEST(Modes, OfACartWithoutSpringAreRigidAndOscillating) {
  const double M = 1.5, m = 0.7, l = 0.6, g = 9.81;
  const Modes found = modes_of("cart_pendulum", {{"M", M}, {"m", m}, {"l", l}, {"g", g}, {"k", 0}});
  EXPECT_EQ(kinds(found), "rigid oscillation");
  expect_shape(found.modes[0], {1, 0});
  expect_omega(found.modes[1], std::sqrt((M + m) * g / (M * l)));
  expect_shape(found.modes[1], {1, -(M + m) / (m * l)});
  EXPECT_THAT(found.mass, testing::Pointwise(testing::DoubleEq(), {M + m, m * l, m * l, m * l * l}));
  EXPECT_THAT(found.stiffness, testing::Pointwise(testing::DoubleEq(), {0.0, 0.0, 0.0, m * g * l}));
  EXPECT_EQ(found.stability, Stability::stable);
}

TEST(Modes, WithoutGravityLetTheAngleStayWhereItIs) {
  const double M = 1.5, m = 0.7, l = 0.6, k = 30, theta = 0.5;
  const Modes found =
      modes_of("cart_pendulum", {{"M", M}, {"m", m}, {"l", l}, {"g", 0}, {"k", k}, {"theta", theta}});
  EXPECT_EQ(kinds(found), "rigid oscillation");
  expect_shape(found.modes[0], {0, 1});
  EXPECT_EQ(found.y[1], theta);
  expect_omega(found.modes[1], std::sqrt(k / (M + m * std::sin(theta) * std::sin(theta))));
  EXPECT_EQ(kinds(modes_of("spring_pendulum", {{"g", 0}})), "rigid oscillation");
  EXPECT_EQ(kinds(modes_of("cart_pendulum", {{"g", 0}, {"k", 0}})), "rigid rigid");
}

TEST(Modes, KeepTheirDigitsWhenOneMassIsNextToNothing) {
  for (const double ratio : {1e-12, 1e-6, 1e6, 1e12}) {
    const double m = 0.7, M = ratio * m, l = 0.6, g = 9.81;
    const Modes found = modes_of("cart_pendulum", {{"M", M}, {"m", m}, {"l", l}, {"g", g}, {"k", 0}});
    expect_omega(found.modes[1], std::sqrt((1 + m / M) * g / l));
    const double k = 12;  // M m l^2 w^2 - ((M + m) m g l + k m l^2) w + k m g l = 0 for w = omega^2
    const Modes sprung = modes_of("cart_pendulum", {{"M", M}, {"m", m}, {"l", l}, {"g", g}, {"k", k}});
    const long double a = static_cast<long double>(M) * l;
    const long double b = (static_cast<long double>(M) + m) * g + static_cast<long double>(k) * l;
    const long double c = static_cast<long double>(k) * g;
    const long double root = std::sqrt(b * b - 4 * a * c);
    expect_omega(sprung.modes[0], static_cast<double>(std::sqrt(2 * c / (b + root))), 1e-9);
    expect_omega(sprung.modes[1], static_cast<double>(std::sqrt((b + root) / (2 * a))));
  }
}

TEST(Modes, OfAStiffSpringKeepTheirDigits) {
  const double m = 0.8, k = 1e9, l0 = 0.75, g = 9.81;
  const Modes found = modes_of("spring_pendulum", {{"m", m}, {"k", k}, {"l0", l0}, {"g", g}});
  expect_omega(found.modes[0], std::sqrt(g / (l0 + m * g / k)));
  expect_omega(found.modes[1], std::sqrt(k / m));
}

TEST(Modes, OfOneFrequencyAreAnyCombination) {
  // k = m g/l_e with exact numbers: m = 1, g = 8, k = 4, l0 = 0, l_e = 2.
  const Modes found = modes_of("spring_pendulum", {{"m", 1}, {"k", 4}, {"l0", 0}, {"g", 8}});
  ASSERT_EQ(kinds(found), "oscillation oscillation");
  for (const Mode& mode : found.modes) {
    EXPECT_EQ(mode.multiplicity, 2U);
    EXPECT_EQ(mode.omega, 2);
    ASSERT_TRUE(mode.omega_error);
    EXPECT_LE(*mode.omega_error, tight);
  }
  expect_shape(found.modes[0], {1, 0});
  expect_shape(found.modes[1], {0, 1});
}

TEST(Modes, OfTheRodWithASpringHaveTheRadialOneApart) {
  test::Random random(3);
  for (int i = 0; i < 30; ++i) {
    const double m = random.real(0.1, 3), l = random.real(0.2, 2), k = random.real(5, 300),
                 l0 = random.real(0.1, 2), g = random.real(1, 20);
    const Modes found = modes_of("rod_spring_pendulum", {{"m", m}, {"l", l}, {"k", k}, {"l0", l0}, {"g", g}});
    ASSERT_EQ(kinds(found), "oscillation oscillation oscillation");
    const double r = l0 + m * g / k;
    const double a = l * r / 3, b = g * (1.5 * r + 4 * l / 3), c = 1.5 * g * g;
    const double root = std::sqrt(b * b - 4 * a * c);
    std::vector<double> expected{std::sqrt(2 * c / (b + root)), std::sqrt((b + root) / (2 * a)),
                                 std::sqrt(k / m)};
    std::sort(expected.begin(), expected.end());
    for (std::size_t j = 0; j < 3; ++j) {
      expect_omega(found.modes[j], expected[j]);
      const double w = found.modes[j].omega * found.modes[j].omega;
      const bool radial = std::abs(w - k / m) < 1e-9 * w;
      if (radial) expect_shape(found.modes[j], {0, 0, 1});
      if (!radial)
        expect_shape(found.modes[j], {1, (1.5 * g * l - 4 * w * l * l / 3) / (w * l * r), 0}, 1e-9);
    }
  }
}

TEST(Modes, OfTheWhirlingPendulumFollowItsPitchfork) {
  test::Random random(5);
  for (int i = 0; i < 30; ++i) {
    const double l = random.real(0.2, 2), g = random.real(1, 20), G = g / l;
    const double slow = random.real(0, 0.95) * std::sqrt(G), fast = random.real(1.05, 4) * std::sqrt(G);
    const Modes below = modes_of("whirling_pendulum", {{"l", l}, {"g", g}, {"Omega", slow}});
    EXPECT_EQ(below.y[0], 0);
    expect_omega(below.modes[0], std::sqrt(G - slow * slow), 1e-11);
    const Modes above = modes_of("whirling_pendulum", {{"l", l}, {"g", g}, {"Omega", -fast}});
    EXPECT_NEAR(above.y[0], std::acos(G / (fast * fast)), 1e-13);
    expect_omega(above.modes[0], std::sqrt(fast * fast - G * G / (fast * fast)), 1e-11);
    const Modes upright =
        modes_of("whirling_pendulum", {{"l", l}, {"g", g}, {"Omega", fast}}, std::vector<double>{0});
    EXPECT_EQ(upright.y[0], 0);
    EXPECT_EQ(kinds(upright), "growth");
    EXPECT_NEAR(upright.modes[0].rate, std::sqrt(fast * fast - G), 1e-11 * fast);
    const Modes inverted =
        modes_of("whirling_pendulum", {{"l", l}, {"g", g}, {"Omega", slow}}, std::vector<double>{pi});
    EXPECT_EQ(inverted.stability, Stability::unstable);
    EXPECT_NEAR(inverted.modes[0].rate, std::sqrt(slow * slow + G), promised * 30);
  }
}

TEST(Modes, AtTheCriticalSpinAreNotDecided) {
  for (const double g : {8.0, 9.81, 3.7}) {
    const double l = 0.5;
    const Modes found = modes_of("whirling_pendulum", {{"l", l}, {"g", g}, {"Omega", std::sqrt(g / l)}},
                                 std::vector<double>{0});
    EXPECT_EQ(kinds(found), "neutral") << g;
    EXPECT_EQ(found.stability, Stability::neutral);
    EXPECT_FALSE(found.undecided.empty());
    const double critical = std::sqrt(g / l);
    for (const double side : {-1e-9, 1e-9}) {
      const double Omega = critical * (1 + side);
      const Modes near =
          modes_of("whirling_pendulum", {{"l", l}, {"g", g}, {"Omega", Omega}}, std::vector<double>{0});
      const long double exact = static_cast<long double>(g) / l - static_cast<long double>(Omega) * Omega;
      const double expected = static_cast<double>(std::sqrt(std::abs(exact)));
      ASSERT_EQ(kinds(near), side < 0 ? "oscillation" : "growth");
      EXPECT_NEAR(side < 0 ? near.modes[0].omega : near.modes[0].rate, expected, 1e-9 * expected);
      EXPECT_EQ(modes_of("whirling_pendulum", {{"l", l}, {"g", g}, {"Omega", Omega}}).stability,
                Stability::stable);
    }
  }
}

TEST(Modes, OfTheSteadyConeAreItsNutation) {
  test::Random random(7);
  for (int i = 0; i < 30; ++i) {
    const double l = random.real(0.2, 2), g = random.real(1, 20), G = g / l, theta = random.real(0.05, 1.4);
    const double A = 0.5 + std::sin(theta);
    const double spin = std::sqrt(G * std::sin(theta) / (A * std::cos(theta)));
    const Modes found =
        modes_of("free_spin_pendulum", {{"l", l}, {"g", g}, {"theta", theta}, {"psi_dot", spin}});
    ASSERT_EQ(kinds(found), "rigid oscillation");
    EXPECT_NEAR(found.y[0], theta, 1e-12);
    EXPECT_NEAR(found.y[3], spin, 1e-12 * spin);
    const double c = std::cos(theta);
    const double nutation = std::sqrt(spin * spin * (3 * c * c + A * std::sin(theta)) + G * c);
    expect_omega(found.modes[1], nutation, 1e-11);
    ASSERT_FALSE(found.gyroscopic.empty());
    // psi' = beta/(m l^2 A^2): i omega u_psi = -2 psi' cos(theta)/A u_theta.
    EXPECT_EQ(found.modes[1].shape[0], 1.0);
    EXPECT_EQ(found.modes[1].shape[1].real(), 0);
    EXPECT_NEAR(found.modes[1].shape[1].imag(), 2 * spin * c / (A * nutation), 1e-10);
  }
  EXPECT_EQ(kinds(modes_of("free_spin_pendulum")), "rigid oscillation");
}

TEST(Modes, OfTheOtherPracticeProblems) {
  const Modes orbiting = modes_of("orbiting_pendulum", {{"l", 0.5}, {"r", 0.8}, {"omega0", -3}});
  expect_omega(orbiting.modes[0], 3 * std::sqrt(0.8 / 0.5));
  const Modes disk = modes_of("rolling_disk_platform", {{"g", 0}, {"Omega", 1.5}});
  EXPECT_EQ(kinds(disk), "growth");
  EXPECT_NEAR(disk.modes[0].rate, std::sqrt(2.0 / 3) * 1.5, promised);
  EXPECT_THROW((void)modes_of("rolling_disk_platform", {{"g", 9.81}, {"Omega", 1.5}}), Error);
  const double Omega = 2, l = 0.5, g = 9.81, G = g / l;
  const Modes bar = modes_of("rotating_l_bar", {{"l", l}, {"g", g}, {"Omega", Omega}});
  const double theta = bar.y[0];
  EXPECT_NEAR(Omega * Omega * (53 * std::sin(2 * theta) - 9 * std::cos(2 * theta)),
              3 * G * (15 * std::sin(theta) - std::cos(theta)), 1e-10);
  expect_omega(bar.modes[0],
               std::sqrt(3.0 / 55 *
                         (G * (15 * std::cos(theta) + std::sin(theta)) / 2 -
                          Omega * Omega * (53.0 / 3 * std::cos(2 * theta) + 3 * std::sin(2 * theta)))),
               1e-11);
}

TEST(Modes, OfTheWalkerGrowWhateverItsFeetWeigh) {
  for (const double m : {0.0, 1e-9, 0.01, 0.5}) {
    const double gamma = 0.01;
    const Modes found = modes_of("compass_walker", {{"m", m}, {"gamma", gamma}, {"l", 1}, {"g", 9.81}});
    EXPECT_NEAR(found.y[0], gamma, 1e-15);
    EXPECT_EQ(found.y[1], 0);
    EXPECT_EQ(found.stability, Stability::unstable);
    EXPECT_EQ(kinds(found), "growth oscillation") << m;
    if (m == 0) {  // theta'' = G (theta - gamma), phi'' = theta'' - G phi ...
      EXPECT_NEAR(found.modes[0].rate, std::sqrt(9.81), promised * 3);
      expect_omega(found.modes[1], std::sqrt(9.81));
      expect_shape(found.modes[1], {0, 1});
    }
  }
}

TEST(Modes, StayWhereAnEquilibriumIsGivenExactly) {
  const Modes up = modes_of("rod_pendulum", {}, std::vector<double>{pi, pi});
  EXPECT_EQ(kinds(up), "growth growth");
  EXPECT_EQ(up.y[0], pi);
  const Modes saddle = modes_of("cart_pendulum", {}, std::vector<double>{0, 3.1});
  EXPECT_EQ(saddle.y[1], pi);
  EXPECT_EQ(kinds(saddle), "growth oscillation");
  EXPECT_EQ(saddle.stability, Stability::unstable);
}

// Gyroscopic and damping terms.

TEST(Modes, OfFoucaultsPendulumAreTwoCircles) {
  const Scene scene = test::scene_of("foucault");
  const Modes found = modes_of("foucault");
  const auto model = test::model_of("foucault");
  ASSERT_EQ(kinds(found), "oscillation oscillation");
  ASSERT_FALSE(found.gyroscopic.empty());
  EXPECT_EQ(found.gyroscopic[1], -found.gyroscopic[2]);
  EXPECT_TRUE(found.damping.empty());
  const double coriolis = found.gyroscopic[2] / found.mass[0], w = found.stiffness[0] / found.mass[0];
  const double middle = std::sqrt(w + coriolis * coriolis / 4);
  expect_omega(found.modes[0], middle - std::abs(coriolis) / 2);
  expect_omega(found.modes[1], middle + std::abs(coriolis) / 2);
  for (const Mode& mode : found.modes) {
    EXPECT_EQ(mode.shape[0], 1.0);
    EXPECT_EQ(mode.shape[1].real(), 0);
    EXPECT_NEAR(std::abs(mode.shape[1].imag()), 1, promised);
  }
}

TEST(Modes, OfAMagneticParticleCircle) {
  const Modes found = modes_of("magnetic_particle");
  const auto last = found.modes.back();
  EXPECT_EQ(last.kind, ModeKind::oscillation);
  EXPECT_NEAR(std::abs(last.shape[1]), 1, promised);
}

}  // namespace
}  // namespace qdot::modes_test
