// Masses below zero: refused where nothing outweighs them, and admitted as the hole that they are elsewhere.

#include "core/mechanics/negative_inertia.hpp"

#include <gtest/gtest.h>

#include "core/mechanics/model.hpp"

namespace qdot {
namespace {

constexpr Domain positive{.lower = 0, .lower_open = true};

Parameter parameter(const std::string& name, const std::string& unit) {
  return {name, unit, "1", positive, "", ""};
}

Particle particle(const std::string& mass, const std::vector<std::string>& position) {
  Particle body;
  body.mass = mass;
  body.position.components = position;
  return body;
}

/// A particle on a line.
Scene on_a_line(const std::string& mass) {
  Scene scene;
  scene.name = "line";
  scene.parameters = {parameter("m", "kg"), parameter("M", "kg"), parameter("l", "m")};
  scene.coordinates.resize(1);
  scene.coordinates[0].name = "x";
  scene.coordinates[0].unit = "m";
  scene.coordinates[0].initial = scene.coordinates[0].initial_rate = "0";
  scene.bodies = {particle(mass, {"x", "0"})};
  return scene;
}

std::vector<std::string> places_in(const Scene& scene) {
  std::vector<std::string> places;
  try {
    (void)build_model(scene);
  } catch (const SceneError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics()) places.push_back(diagnostic.place);
  }
  return places;
}

using Places = std::vector<std::string>;

TEST(NegativeInertia, AMassThatNothingOutweighsIsRefusedAtItsPlace) {
  EXPECT_EQ(places_in(on_a_line("-1")), Places{"/bodies/0/mass"});
  EXPECT_EQ(places_in(on_a_line("-m")), Places{"/bodies/0/mass"});
  EXPECT_EQ(places_in(on_a_line("m")), Places{});
  EXPECT_EQ(places_in(on_a_line("m - 2*M")), Places{}) << "its sign is that of a request's values";
}

TEST(NegativeInertia, AHoleInABodyThatOutweighsItIsAdmitted) {
  Scene plate = on_a_line("4");
  plate.bodies.emplace_back(particle("-1", {"x", "l"}));
  EXPECT_EQ(places_in(plate), Places{});
  std::get<Particle>(plate.bodies[1]).mass = "-5";
  EXPECT_EQ(places_in(plate), Places{"/bodies/1/mass"});
}

TEST(NegativeInertia, OfAPendulumIsSeenThroughItsAngle) {
  Scene pendulum = on_a_line("-m");
  pendulum.coordinates[0].unit = "rad";
  std::get<Particle>(pendulum.bodies[0]).position.components = {"l*sin(x)", "-l*cos(x)"};
  EXPECT_EQ(places_in(pendulum), Places{"/bodies/0/mass"});
}

TEST(NegativeInertia, AMomentBelowZeroIsRefusedWhereTheMassIsNot) {
  Scene wheel = on_a_line("m");
  wheel.coordinates[0].unit = "rad";
  RigidBody body;
  body.mass = "m";
  body.shape = "rigid_body";
  body.centre.components = {"0", "0"};
  body.inertia = "-2";
  body.angle = "x";
  wheel.bodies = {body};
  EXPECT_EQ(places_in(wheel), Places{"/bodies/0"});
  std::get<RigidBody>(wheel.bodies[0]).inertia = "2";
  EXPECT_EQ(places_in(wheel), Places{});
}

}  // namespace
}  // namespace qdot
