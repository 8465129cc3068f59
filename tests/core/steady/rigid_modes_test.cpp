// Molecules without a wall: modes along the symmetries of what binds them are rigid, and their equilibrium is
// one of a proven family.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/steady/constrained_modes.hpp"
#include "tests/core/steady/modes_support.hpp"

namespace qdot::rigid_modes_test {
namespace {

using test::kinds;

using Places = std::vector<std::vector<std::string>>;
using Bonds = std::vector<std::pair<std::size_t, std::size_t>>;

/// Atoms that start at `starts`, springs of rest length b along the bonds.
Scene molecule(const Places& starts, const Bonds& bonds) {
  Scene scene;
  scene.name = "molecule";
  scene.parameters = {
      {"m", "kg", "1", {}, "", ""}, {"k", "N/m", "5", {}, "", ""}, {"b", "m", "1", {}, "", ""}};
  Places names;
  for (std::size_t atom = 0; atom < starts.size(); ++atom) {
    names.emplace_back();
    for (std::size_t axis = 0; axis < starts[atom].size(); ++axis) {
      names.back().push_back(std::string("xyz").substr(axis, 1) + std::to_string(atom + 1));
      scene.coordinates.push_back({names.back().back(), "m", starts[atom][axis], "0", "", {}, "", ""});
    }
    scene.points.push_back({"p" + std::to_string(atom + 1), names.back()});
    scene.bodies.emplace_back(
        Particle{"p" + std::to_string(atom + 1), "m", {"p" + std::to_string(atom + 1), {}}});
  }
  for (const auto& [i, j] : bonds) {
    std::string square;
    for (std::size_t axis = 0; axis < names[i].size(); ++axis)
      square += (axis == 0 ? "(" : " + (") + names[i][axis] + " - " + names[j][axis] + ")^2";
    scene.springs.push_back({"s" + std::to_string(i) + std::to_string(j), "k", "sqrt(" + square + ")", "b"});
  }
  return scene;
}

Modes small_motions_of(const std::shared_ptr<const Model>& model) { return test::modes_of(model, {}); }

const Places triangle{{"0", "0"}, {"b", "0"}, {"b/2", "b*sqrt(3)/2"}};
const Bonds triangle_bonds{{0, 1}, {1, 2}, {0, 2}};

void expect_proven(const Modes& found, double within) {
  for (const auto& error : found.y_error) {
    ASSERT_TRUE(error);
    EXPECT_LE(*error, within);
  }
}

/// Landau, Lifshitz, Mechanics, section 24: 3 k/(2 m) twice, 3 k/m, and what a plane allows a rigid body.
TEST(RigidModes, OfATriangleInThePlaneAreThree) {
  const Modes found = small_motions_of(build_model(molecule(triangle, triangle_bonds)));
  EXPECT_EQ(kinds(found), "rigid rigid rigid oscillation oscillation oscillation");
  EXPECT_EQ(found.stability, Stability::stable);
  EXPECT_EQ(found.held, (std::vector<std::size_t>{0, 1, 3}));
  for (const std::size_t held : found.held) EXPECT_EQ(found.y[held], 0);
  expect_proven(found, 1e-16);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(found.modes[i].omega_error, 0);
    EXPECT_EQ(found.modes[i].multiplicity, 3U);
  }
  EXPECT_NEAR(found.modes[3].omega, std::sqrt(7.5), 1e-15);
  EXPECT_NEAR(found.modes[5].omega, std::sqrt(15), 1e-15);
}

TEST(RigidModes, OfAPairAndOfAChainAreThoseOfTheirJoints) {
  const auto pair = build_model(molecule({{"0.1", "0.2"}, {"0.9", "0.5"}}, {{0, 1}}));
  EXPECT_EQ(kinds(small_motions_of(pair)), "rigid rigid rigid oscillation");
  expect_proven(small_motions_of(pair), 1e-16);
  const auto chain = build_model(molecule({{"0", "0"}, {"b", "0"}, {"2*b", "0"}}, {{0, 1}, {1, 2}}));
  EXPECT_EQ(kinds(small_motions_of(chain)), "rigid rigid rigid rigid oscillation oscillation");
}

TEST(RigidModes, InSpaceAreSixAndFiveOfWhatIsStraight) {
  const Places tetrahedron{
      {"0", "0", "0"}, {"b", "0", "0"}, {"b/2", "b*sqrt(3)/2", "0"}, {"b/2", "b*sqrt(3)/6", "b*sqrt(2/3)"}};
  const Modes four =
      small_motions_of(build_model(molecule(tetrahedron, {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}})));
  EXPECT_EQ(kinds(four).substr(0, 41), "rigid rigid rigid rigid rigid rigid oscil");
  expect_proven(four, 1e-16);
  const Modes two = small_motions_of(build_model(molecule({{"0", "0", "0"}, {"b", "0", "0"}}, {{0, 1}})));
  EXPECT_EQ(kinds(two), "rigid rigid rigid rigid rigid oscillation");
}

/// Friction between two atoms leaves the translations free, each of which answers for two eigenvalues zero,
/// and brakes a turn.
TEST(RigidModes, AreThereWithFrictionInTheMolecule) {
  Scene scene = molecule(triangle, triangle_bonds);
  scene.parameters.push_back({"c", "kg/s", "0.1", {}, "", ""});
  scene.dissipation = "c*((x1_dot - x2_dot)^2 + (y1_dot - y2_dot)^2)/2";
  const Modes found = small_motions_of(build_model(scene));
  EXPECT_EQ(kinds(found), "rigid rigid rigid decay decay decay decay");
}

/// A valley that is flat by its fourth power alone is no symmetry.
TEST(RigidModes, AreNotThoseThatHigherTermsHold) {
  Scene scene = molecule(triangle, triangle_bonds);
  scene.potential = "k*(y2 - y1)^4/b^2";
  const Modes found = small_motions_of(build_model(scene));
  EXPECT_EQ(kinds(found), "rigid rigid neutral oscillation oscillation oscillation");
  EXPECT_EQ(found.stability, Stability::neutral);
}

TEST(RigidModes, OfARodHeldByAConstraintAreThree) {
  Scene scene = molecule(triangle, {{1, 2}, {0, 2}});
  scene.constraints = {{"rod", "(x2 - x1)^2 + (y2 - y1)^2 - b^2", "lambda", ""}};
  const auto model = build_model(scene);
  const std::vector<double> parameters = parameter_values(*model, {});
  const Modes found =
      constrained_modes(Dynamics(model), parameters, initial_state(*model, parameters, {}), std::nullopt);
  EXPECT_EQ(kinds(found), "rigid rigid rigid oscillation oscillation");
  EXPECT_EQ(found.stability, Stability::stable);
}

/// Started 0.02 of a bond off: beside its family K along it is as small as the way there.
TEST(RigidModes, AreFoundFromBesideTheRestShape) {
  const Places starts{
      {"0.94*b", "0.17*b"}, {"0.2*b", "1.11*b"}, {"-1.02*b", "0.17*b"}, {"0.14*b", "-0.87*b"}};
  Scene scene = molecule(starts, {{1, 0}, {2, 0}, {2, 1}, {3, 0}, {3, 1}, {3, 2}});
  const std::vector<std::string> lengths{"1.2*b", "1.96*b", "1.54*b", "1.31*b", "1.98*b", "1.56*b"};
  const std::vector<std::string> stiffness{"2*k", "1*k", "7*k", "4*k", "3*k", "3*k"};
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    scene.springs[i].rest_length = lengths[i];
    scene.springs[i].stiffness = stiffness[i];
  }
  const Modes found = small_motions_of(build_model(scene));
  EXPECT_EQ(kinds(found).find("rigid rigid rigid oscillation"), 0U);
  EXPECT_EQ(found.held.size(), 3U);
  expect_proven(found, 1e-14);
}

/// U of two equal springs is a square of a length: it has a turn, about this very place.
TEST(RigidModes, OfAChainOnALineAreOneWithErrorsOfItsPlaces) {
  Scene scene = molecule({{"0", "0"}, {"0.14*b", "0"}, {"-0.15*b", "0"}}, {});
  std::erase_if(scene.coordinates, [](const Coordinate& q) { return q.name[0] == 'y'; });
  for (Point& point : scene.points) point.components[1] = "0";
  scene.potential = "k/2*((x2 - x1)^2 + (x3 - x2 - 0.48*b)^2)";
  const Modes found = small_motions_of(build_model(scene));
  EXPECT_EQ(kinds(found), "rigid oscillation oscillation");
  EXPECT_EQ(found.held.size(), 1U);
  expect_proven(found, 1e-15);
}

}  // namespace
}  // namespace qdot::rigid_modes_test
