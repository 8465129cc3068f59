// The modes of masses on springs with friction between them: decays, what is rigid, and the same in any
// units.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>

#include "tests/core/steady/modes_support.hpp"

namespace qdot::modes_of_masses_test {
namespace {

using test::expect_omega, test::expect_shape, test::kinds, test::modes_of;

Scene oscillator(const std::string& damping, int coordinates = 1) {
  Scene scene;
  scene.name = "oscillator";
  scene.parameters = {
      {"m", "kg", "2", {}, "", ""}, {"k", "N/m", "18", {}, "", ""}, {"c", "N*s/m", "1", {}, "", ""}};
  scene.coordinates = {{"x", "m", "0.1", "0", "", {}, "", ""}};
  scene.points = {{"p", {"x", "0"}}};
  scene.bodies = {Particle{"p", "m", {"p", {}}}};
  scene.springs = {{"s", "k", "x", "0"}};
  if (coordinates == 2) {
    scene.coordinates.push_back({"y", "m", "0.3", "0", "", {}, "", ""});
    scene.points.push_back({"q", {"y", "0"}});
    scene.bodies.emplace_back(Particle{"q", "m", {"q", {}}});
    scene.springs = {{"s", "k", "y - x", "0"}};
  }
  scene.dissipation = damping;
  return scene;
}

TEST(ModesOfMasses, OfADampedOscillatorDecay) {
  const auto model = build_model(oscillator("c*x_dot^2/2"));
  const Modes weak = modes_of(model, {{"c", 3}});
  ASSERT_EQ(kinds(weak), "decay");
  EXPECT_NEAR(weak.modes[0].rate, 0.75, 1e-15);
  EXPECT_NEAR(weak.modes[0].omega, std::sqrt(9 - 0.75 * 0.75), 1e-15);
  EXPECT_EQ(weak.damping, std::vector<double>{3});
  EXPECT_EQ(weak.stability, Stability::stable);
  const Modes strong = modes_of(model, {{"c", 20}});  // 2 s^2 + 20 s + 18
  ASSERT_EQ(kinds(strong), "decay decay");
  EXPECT_NEAR(strong.modes[0].rate, 9, 1e-14);
  EXPECT_NEAR(strong.modes[1].rate, 1, 1e-15);
  const Modes critical = modes_of(model, {{"c", 12}});
  ASSERT_EQ(kinds(critical), "decay decay");
  EXPECT_EQ(critical.modes[0].rate, 3);
  EXPECT_EQ(critical.modes[0].multiplicity, 2U);
}

/// Two masses on springs that drag each other, and one alone: nothing is rigid.
TEST(ModesOfMasses, AreTheSameInAnyUnits) {
  Scene both = oscillator("c*(x_dot^2 - x_dot*y_dot + y_dot^2)/2", 2);
  both.springs = {{"s", "k", "x", "0"}, {"t", "k", "y", "0"}};
  const auto pair = build_model(both), single = build_model(oscillator("c*x_dot^2/2"));
  for (const double mass : {1e-200, 1e-150, 1.0, 1e150, 1e200}) {
    for (const double rate : {1e-20, 1.0, 1e20}) {
      const Values scaled{{"m", 2 * mass}, {"k", 18 * mass * rate * rate}, {"c", mass * rate}};
      const Modes two = modes_of(pair, scaled), one = modes_of(single, scaled);
      ASSERT_EQ(kinds(two), "decay decay") << mass << " " << rate;
      ASSERT_EQ(kinds(one), "decay") << mass << " " << rate;
      for (const auto& [mode, decay] :
           {std::pair{two.modes[0], 0.375}, {two.modes[1], 0.125}, {one.modes[0], 0.25}}) {
        EXPECT_NEAR(mode.rate / rate, decay, 1e-15);
        EXPECT_NEAR(mode.omega / rate, std::sqrt(9 - decay * decay), 1e-14);
        ASSERT_TRUE(mode.omega_error);
        EXPECT_LE(*mode.omega_error, 1e-15 * mode.omega);
      }
    }
  }
}

TEST(ModesOfMasses, OfTwoMassesThatDragEachOther) {
  const auto model = build_model(oscillator("c*(y_dot - x_dot)^2/2", 2));
  const Modes found = modes_of(model, {{"c", 1}});  // relative: m/2 s^2 + c s + k
  EXPECT_EQ(kinds(found), "rigid decay");
  EXPECT_NEAR(found.modes[1].rate, 0.5, 1e-14);
  EXPECT_NEAR(found.modes[1].omega, std::sqrt(18 - 0.25), 1e-14);
  expect_shape(found.modes[0], {1, 1});
  expect_shape(found.modes[1], {1, -1});
}

TEST(ModesOfMasses, OfTwoMassesOnASpringHaveARigidOne) {
  const Modes found = modes_of(build_model(oscillator("", 2)), {});
  EXPECT_EQ(kinds(found), "rigid oscillation");
  expect_shape(found.modes[0], {1, 1});
  expect_shape(found.modes[1], {1, -1});
  expect_omega(found.modes[1], std::sqrt(18));
}

TEST(ModesOfMasses, OfTwoMassesDampedApart) {
  const auto model = build_model(oscillator("c*x_dot^2/2", 2));
  const Modes found = modes_of(model, {{"c", 1}});
  EXPECT_EQ(found.modes[0].kind, ModeKind::rigid);
  // 0 = (s^2 m + s c + k)(s^2 m + k) - k^2 = s (m^2 s^3 + c m s^2 + 2 k m s + c k)
  for (const Mode& mode : found.modes) {
    if (mode.kind == ModeKind::rigid) continue;
    ASSERT_EQ(mode.kind, ModeKind::decay);
    const std::complex<double> s(-mode.rate, mode.omega);
    EXPECT_NEAR(std::abs(4.0 * s * s * s + 2.0 * s * s + 72.0 * s + 18.0), 0, 1e-12);
    ASSERT_TRUE(mode.rate_error);
    EXPECT_LE(*mode.rate_error, 1e-15);
  }
  EXPECT_EQ(found.modes.size(), 3U);
}

}  // namespace
}  // namespace qdot::modes_of_masses_test
