// What constraints in the velocities leave constant, with their names and values.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "core/expr/print/print.hpp"
#include "core/symmetry/found_quantities.hpp"
#include "tests/support/scenes.hpp"

namespace qdot::constrained_momenta_test {
namespace {

/// Beside ignorable coordinates and the energy.
std::map<std::string, std::string> found_in(const std::string& json) {
  const auto model = test::model_written(json);
  const FoundQuantities found =
      found_quantities(*model, model->lagrangian, {}, conserved_quantities(model->lagrangian, model->scene));
  std::map<std::string, std::string> values;
  for (const ConservedQuantity& one : found.quantities) values[one.name] = print(one.value, Form::text);
  return values;
}

std::string edge(const std::string& potential) {
  return R"json({"name": "knife", "units": "none", "parameters": [{"name": "k", "default": "1"}],
    "coordinates": [{"name": "x", "initial": "0"}, {"name": "y", "initial": "0"}, {"name": "phi", "initial": "0.3"}],
    "lagrangian": "(x_dot^2 + y_dot^2 + phi_dot^2)/2 - )json" +
         potential + R"json(",
    "constraints": [{"name": "edge", "expression": "x_dot*sin(phi) - y_dot*cos(phi)"}]})json";
}

TEST(ConstrainedMomenta, AKnifeKeepsItsSpeedAlongItsEdge) {
  const auto found = found_in(edge("0"));
  ASSERT_TRUE(found.contains("momentum_x_y"));
  EXPECT_FALSE(found_in(edge("k*x")).contains("momentum_x_y"));
  EXPECT_TRUE(found_in(edge("k*cos(phi)")).contains("momentum_x_y"));
}

std::string bead(const std::string& constraint) {
  return R"json({"name": "bead", "units": "none", "parameters": [{"name": "k", "default": "2"}, {"name": "g", "default": "9.81"}],
    "coordinates": [{"name": "x", "initial": "1"}, {"name": "y", "initial": "2"}],
    "lagrangian": "(x_dot^2 + y_dot^2)/2 - g*y",
    "constraints": [{"name": "wire", "expression": ")json" +
         constraint + R"json("}]})json";
}

TEST(ConstrainedMomenta, WhatAConstraintMakesZeroIsNoQuantityOfTheMotion) {
  for (const char* wire : {"y - k*x", "x - y/k", "3*(k*x - y)"}) {
    const auto found = found_in(bead(wire));
    EXPECT_TRUE(found.contains("momentum_x_y")) << wire;
    EXPECT_TRUE(found.contains("boost_x_y")) << wire;
    EXPECT_FALSE(found.contains("symmetry_x_y")) << wire;
  }
}

/// A wheel that a force pulls without slipping.
TEST(ConstrainedMomenta, WhatRollsStraightKeepsEachQuantityOnce) {
  const auto found = found_in(R"json({"name": "wheel", "units": "none",
    "parameters": [{"name": "J", "default": "1"}, {"name": "R", "default": "0.2"}, {"name": "F", "default": "3"}],
    "coordinates": [{"name": "x"}, {"name": "th"}], "lagrangian": "(x_dot^2 + J*th_dot^2)/2",
    "forces": [{"value": "F", "along": "x"}, {"value": "-F/3", "along": "th"}],
    "constraints": [{"name": "roll", "expression": "x_dot - R*th_dot"}]})json");
  std::vector<std::string> names, values;
  for (const auto& [name, value] : found) {
    names.push_back(name);
    if (name != "h") values.push_back(value);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"boost_x_th", "h", "momentum_x_th"}));
  EXPECT_EQ(std::ranges::count(values, found.at("momentum_x_th")), 1);
  EXPECT_EQ(found.at("h").find("1/2*R"), std::string::npos) << found.at("h");
}

TEST(ConstrainedMomenta, AConstraintShortensWhatItKeepsConstant) {
  const auto found = found_in(R"json({"name": "pulleys", "units": "none",
    "parameters": [{"name": "m1", "default": "2"}, {"name": "m2", "default": "3"}, {"name": "m3", "default": "1"}],
    "coordinates": [{"name": "a", "initial": "2"}, {"name": "b", "initial": "3"}, {"name": "c", "initial": "3"}],
    "lagrangian": "(m1*a_dot^2 + m2*b_dot^2 + m3*c_dot^2)/2 + 9.81*(m1*a + m2*b + m3*c)",
    "constraints": [{"name": "string", "expression": "2*a + b + c - 10"}]})json");
  EXPECT_NE(found.at("boost_a_c").find("m3*c"), std::string::npos) << found.at("boost_a_c");
  EXPECT_EQ(found.at("boost_a_c").find("*b"), std::string::npos) << found.at("boost_a_c");
}

/// A ball of radius 1 and moments I1, I2, I3 that rolls on a plane, turned by X, Y and Z.
std::string ball(const std::string& moments) {
  return R"json({"name": "ball", "units": "none", "parameters": [{"name": "m", "default": "1"}],
    "coordinates": [{"name": "x", "initial": "0"}, {"name": "y", "initial": "0"}, {"name": "a", "initial": "0.3"},
                    {"name": "b", "initial": "0.4"}, {"name": "c", "initial": "0.2"}],
    "bodies": [{"kind": "rigid_body", "name": "ball", "mass": "m", "principal_moments": [)json" +
         moments +
         R"json(], "centre": ["x", "y", "1"], "orientation": {"sequence": "XYZ", "angles": ["a", "b", "c"]}}],
    "constraints": [
      {"name": "along", "expression": "x_dot - (b_dot*cos(a) - c_dot*sin(a)*cos(b))"},
      {"name": "across", "expression": "y_dot + (a_dot + c_dot*sin(b))"}]
})json";
}

TEST(ConstrainedMomenta, AHomogeneousBallThatRollsKeepsItsSpin) {
  const auto found = found_in(ball(R"("2/5*m", "2/5*m", "2/5*m")"));
  ASSERT_TRUE(found.contains("spin_z"));
  EXPECT_EQ(found.at("spin_z"), "2/5*m*(b_dot*sin(a) + c_dot*cos(a)*cos(b))");
  EXPECT_TRUE(found.contains("roll_y"));
}

TEST(ConstrainedMomenta, ChaplyginsBallKeepsAngularMomentumAboutTheContact) {
  const auto found = found_in(ball(R"("1/5*m", "3/10*m", "2/5*m")"));
  EXPECT_TRUE(found.contains("spin_z"));
  EXPECT_TRUE(found.contains("roll_y"));
  EXPECT_FALSE(found.contains("own_spin_z"));
}

TEST(ConstrainedMomenta, ABallWithTwoEqualMomentsHasNoOwnSpinWhereItRolls) {
  EXPECT_FALSE(found_in(ball(R"("1/5*m", "1/5*m", "2/5*m")")).contains("own_spin_z"));
}

}  // namespace
}  // namespace qdot::constrained_momenta_test
