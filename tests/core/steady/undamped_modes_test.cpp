// Modes that damping leaves alone: their rate is 0 exactly, which is proven by their direction, and the
// answer says what they do then.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/core/steady/modes_support.hpp"

namespace qdot::undamped_modes_test {
namespace {

using test::kinds;

/// Two masses between walls, a dashpot between them.
Modes modes_between_walls(const std::string& more, const std::string& stiffness = "k") {
  Scene scene;
  scene.name = "two_masses";
  scene.parameters = {{"m", "kg", "0.7", {}, "", ""},
                      {"k", "N/m", "0.3", {}, "", ""},
                      {"c", "kg/s", "0.1", {}, "", ""},
                      {"b", "m", "1", {}, "", ""}};
  scene.coordinates = {{"x", "m", "0", "0", "", {}, "", ""}, {"y", "m", "0", "0", "", {}, "", ""}};
  scene.points = {{"p", {"x", "0"}}, {"q", {"y", "0"}}};
  scene.bodies = {Particle{"p", "m", {"p", {}}}, Particle{"q", "m", {"q", {}}}};
  scene.potential = "k/2*(x^2 + (x - y)^2) + " + stiffness + "/2*y^2" + more;
  scene.dissipation = "c/2*(x_dot - y_dot)^2";
  return test::modes_of(build_model(scene), {});
}

/// The masses in phase do not move the dashpot: Landau, Lifshitz, Mechanics, section 25.
TEST(UndampedModes, BesideADashpotAreExact) {
  const Modes found = modes_between_walls("");
  ASSERT_EQ(kinds(found), "oscillation decay");
  EXPECT_FALSE(found.modes[0].rate_error);
  EXPECT_NEAR(found.modes[0].omega, std::sqrt(0.3 / 0.7), 1e-16);
  ASSERT_TRUE(found.modes[0].lambda);
  EXPECT_EQ(found.stability, Stability::stable);
  EXPECT_NE(found.undecided.find("linear, so that this is exact"), std::string::npos);
}

TEST(UndampedModes, AreUndampedToFirstOrderWhereForcesAreNotLinear) {
  const Modes found = modes_between_walls(" + k*(x^4 - y^4)/b^2");
  EXPECT_FALSE(found.modes[0].rate_error);
  EXPECT_EQ(found.stability, Stability::neutral);
  EXPECT_NE(found.undecided.find("nonlinear terms decide"), std::string::npos);
}

/// A second oscillator that the first drives in its resonance, by a force of its velocity: it grows as t.
TEST(UndampedModes, AreNotCalledStableWhereAnotherMayDriveThem) {
  Scene scene;
  scene.name = "driven";
  scene.parameters = {
      {"m", "kg", "1", {}, "", ""}, {"k", "N/m", "4", {}, "", ""}, {"c", "kg/s", "1", {}, "", ""}};
  scene.coordinates = {{"x", "m", "0", "0", "", {}, "", ""}, {"y", "m", "0", "0", "", {}, "", ""}};
  scene.points = {{"p", {"x", "0"}}, {"q", {"y", "0"}}};
  scene.bodies = {Particle{"p", "m", {"p", {}}}, Particle{"q", "m", {"q", {}}}};
  scene.potential = "k/2*(x^2 + y^2)";
  scene.forces = {{.name = "drive", .value = "c*x_dot", .along = "y"}};
  const Modes found = test::modes_of(build_model(scene), {});
  EXPECT_EQ(found.stability, Stability::neutral);
  ASSERT_EQ(found.modes.size(), 2U);
  for (const Mode& mode : found.modes) {  // both have the only one there is
    EXPECT_EQ(mode.multiplicity, 2U);
    EXPECT_EQ(mode.shape, (std::vector<std::complex<double>>{0, 1}));
  }
}

TEST(UndampedModes, AreNotThoseWhoseDampingIsBelowRounding) {
  const Modes found = modes_between_walls("", "k*(1 + 1e-15)");
  ASSERT_EQ(kinds(found), "oscillation decay");
  EXPECT_TRUE(found.modes[0].rate_error);
  EXPECT_EQ(found.stability, Stability::neutral);
  EXPECT_NE(found.undecided.find("is not decided"), std::string::npos);
}

/// A free chain whose damper neither its translation nor its outer masses against each other move.
TEST(UndampedModes, AreExactBesideATranslation) {
  Scene scene;
  scene.name = "free chain";
  scene.parameters = {
      {"m", "kg", "1", {}, "", ""}, {"k", "N/m", "4", {}, "", ""}, {"c", "kg/s", "1", {}, "", ""}};
  for (const char* q : {"x", "y", "z"}) {
    scene.coordinates.push_back({q, "m", "0", "0", "", {}, "", ""});
    scene.points.push_back({std::string("p") + q, {q, "0"}});
    scene.bodies.emplace_back(Particle{std::string("p") + q, "m", {std::string("p") + q, {}}});
  }
  scene.potential = "k/2*((y - x)^2 + (z - y)^2)";
  scene.dissipation = "c/2*(x_dot - 2*y_dot + z_dot)^2";
  const Modes found = test::modes_of(build_model(scene), {});
  ASSERT_EQ(kinds(found), "rigid decay oscillation");
  EXPECT_EQ(found.modes[2].lambda, 4);
  EXPECT_FALSE(found.modes[2].rate_error);
  EXPECT_NE(found.undecided.find("by itself it neither grows nor decays"), std::string::npos);
}

}  // namespace
}  // namespace qdot::undamped_modes_test
