#include "api/contract/synonyms.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "api/contract/notes.hpp"

namespace qdot::api {
namespace {

std::vector<Symbol> cart() {
  return {{"M", "kg", {}, "mass of the cart"},
          {"m", "kg", {}, "mass of the bob"},
          {"k", "N/m", {}, "stiffness of the spring between cart and wall"},
          {"l0", "m", {}, "unstretched length of the spring"},
          {"l", "m", {}, "length of the pendulum"},
          {"g", "m/s^2", {}, "gravitational acceleration"},
          {"x", "m", {}, "displacement of the cart"},
          {"theta", "rad", {}, "angle of the pendulum from the downward vertical"},
          {"x_dot", "m/s", {}},
          {"theta_dot", "rad/s", {}}};
}

void expect_meant(const std::string& symbol, const std::vector<std::string>& words) {
  const std::vector<Symbol> known = cart();
  for (const std::string& word : words) EXPECT_EQ(meant_symbol(word, known), symbol) << word;
}

TEST(Synonyms, MarksOfTheStartAreLeftOut) {
  expect_meant("theta", {"theta0", "theta_0", "theta_initial", "initial_theta", "θ0"});
  expect_meant("theta_dot", {"theta_dot0", "thetadot_0"});
  expect_meant("l0", {"l00"});
}

TEST(Synonyms, VelocitiesHaveManySpellings) {
  expect_meant("theta_dot", {"dtheta", "dtheta_dt", "d_theta", "theta_prime", "theta'dot", "omega_theta",
                             "dθ", "omega", "ω"});
  expect_meant("x_dot", {"dx", "vx", "v_x", "x_velocity", "v", "v0", "velocity"});
  EXPECT_EQ(with_dot_for_prime("theta'"), "theta_dot");
  EXPECT_EQ(with_dot_for_prime("theta"), "theta");
}

TEST(Synonyms, ARateIsFirstThatOfAParameter) {
  const std::vector<Symbol> known{{"Omega", "rad/s", {}, "rate of the arm"}, {"theta_dot", "rad/s", {}}};
  for (const char* word : {"w", "angular_velocity"}) EXPECT_EQ(meant_symbol(word, known), "Omega") << word;
}

TEST(Synonyms, MeaningsAreWordsForSymbols) {
  expect_meant("M", {"mass"});
  expect_meant("k", {"stiffness"});
  expect_meant("l", {"length"});
  expect_meant("g", {"gravity", "gravitational"});
  expect_meant("theta", {"angle"});
}

TEST(Synonyms, WhatIsUnlikelyIsNotSuggested) {
  expect_meant("", {"", "q", "0", "spring", "pendulum", "the", "dt", std::string(1000, 'a')});
}

TEST(Notes, AnAngleBeyondATurnWithoutAUnitMayBeInDegrees) {
  const Symbol theta{"theta", "rad", {}, ""};
  EXPECT_EQ(note_on(theta, 30, 30),
            "theta = 30 is read in radians, 4.77465 turns; for degrees write \"30deg\".");
  EXPECT_NE(note_on(theta, "-30", -30), "");
  EXPECT_EQ(note_on(theta, 6.28, 6.28), "");
  EXPECT_EQ(note_on(theta, "30 rad", 30), "");
  EXPECT_EQ(note_on(theta, "10*pi", 31.4), "");
  EXPECT_EQ(note_on({"l", "m", {}, ""}, 30, 30), "");
  EXPECT_EQ(note_on({"theta_dot", "rad/s", {}, ""}, 30, 30), "");
}

TEST(Notes, HertzOfAnAngularVelocityAreTurns) {
  const Symbol omega{"Omega", "rad/s", {}, ""};
  EXPECT_EQ(note_on(omega, "10 Hz", 62.83185307179586),
            "Omega = '10 Hz' counts turns: it is read as 62.8319 rad/s. A number alone is in rad/s.");
  EXPECT_EQ(note_on(omega, "10 rad/s", 10), "");
  EXPECT_EQ(note_on(omega, "60 rpm", 6.28), "") << "its name says turns";
  EXPECT_EQ(note_on({"f", "1/s", {}, ""}, "10 Hz", 10), "");
}

}  // namespace
}  // namespace qdot::api
