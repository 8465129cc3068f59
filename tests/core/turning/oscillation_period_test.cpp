// Periods and turning points in potentials that hide something, against closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "api/scenes/scene_reader.hpp"
#include "core/turning/turning_points.hpp"

namespace qdot {
namespace {

using std::numbers::pi_v;

/// A particle of 1 kg on a line (x) or a circle of 1 m (theta), in a potential [J].
TurningPoints on(const std::string& coordinate, const std::string& potential, double x0, double x0_dot) {
  const bool line = coordinate == "x";
  const api::Json scene{
      {"name", "hidden"},
      {"title", "A particle"},
      {"description", "A particle in a potential."},
      {"parameters",
       {{{"name", "m"}, {"unit", "kg"}, {"default", "1"}, {"domain", "> 0"}},
        {{"name", "u"}, {"unit", "J"}, {"default", "1"}},
        {{"name", "a"}, {"unit", "m"}, {"default", "1"}, {"domain", "> 0"}}}},
      {"coordinates", {{{"name", coordinate}, {"unit", line ? "m" : "rad"}, {"initial", "0"}}}},
      {"points",
       {{{"name", "p"},
         {"components", line ? api::Json{"x", "0"} : api::Json{"a*sin(theta)", "-a*cos(theta)"}}}}},
      {"bodies", {{{"kind", "particle"}, {"name", "p"}, {"mass", "m"}, {"position", "p"}}}},
      {"potential", potential}};
  const api::SceneReading reading = api::read_scene(scene);
  EXPECT_TRUE(reading.errors.empty()) << (reading.errors.empty() ? "" : reading.errors[0].detail);
  const Dynamics dynamics(build_model(reading.scene));
  const std::vector<double> parameters = parameter_values(dynamics.model(), {});
  const std::vector<double> y{x0, x0_dot};
  return turning_points(dynamics, parameters, y);
}

void expect_within(const Finding& found, long double expected, double relative) {
  ASSERT_TRUE(found.value) << found.reason;
  EXPECT_LE(std::abs(*found.value - expected), found.error + 1e-18L * std::abs(expected)) << *found.value;
  EXPECT_LE(found.error, relative * static_cast<double>(std::abs(expected)) + 1e-300);
}

long double mean_of(long double a, long double b) {  // arithmetic-geometric
  for (int i = 0; i < 40; ++i) {
    const long double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return a;
}

/// integral over a turn of dphi/sqrt(2 (e - u cos phi)), from e + u and e - u.
long double turn(long double most, long double least) {
  return 2 * pi_v<long double> / (std::sqrt(2.0L) * mean_of(std::sqrt(most), std::sqrt(least)));
}

TEST(OscillationPeriod, OverFastHarmonicsIsThatOfOneHarmonic) {
  for (const int n : {1, 8, 32, 100}) {
    const TurningPoints found = on("theta", "u*cos(" + std::to_string(n) + "*theta)", 0, 2.25);
    EXPECT_EQ(found.motion, MotionKind::rotation);
    expect_within(found.period, turn(2 + 2.25L * 2.25L / 2, 2.25L * 2.25L / 2), 1e-12);
  }
}

TEST(OscillationPeriod, NextToTheSeparatrixKeepsItsDigits) {
  for (const int exponent : {4, 12, 20, 30}) {  // theta'^2/2 = 2 + 2^-exponent, nearly
    const double rate = 2 + std::ldexp(1.0, -exponent - 1);
    const TurningPoints above = on("theta", "-u*cos(theta)", 0, rate);
    EXPECT_EQ(above.motion, MotionKind::rotation);
    const long double fast = rate;
    expect_within(above.period, turn(fast * fast / 2, (fast - 2) * (fast + 2) / 2), 1e-11);
    const double less = 2 - std::ldexp(1.0, -exponent - 1);
    const TurningPoints below = on("theta", "-u*cos(theta)", 0, less);
    EXPECT_EQ(below.motion, MotionKind::libration);
    const long double k = static_cast<long double>(less) / 2;  // T = 4 K(k)
    expect_within(below.period, 2 * pi_v<long double> / mean_of(1, std::sqrt((1 - k) * (1 + k))), 1e-11);
  }
}

TEST(OscillationPeriod, AcrossAKinkIsThatOfItsTwoSides) {
  // u |x|: from rest at x0 a quarter takes sqrt(2 x0).
  for (const double x0 : {1.0, 0.3, 1e-6}) {
    const TurningPoints found = on("x", "u*abs(x/a)", x0, 0);
    expect_within(found.period, 4 * std::sqrt(2 * static_cast<long double>(x0)), 1e-12);
    expect_within(found.minimum, -static_cast<long double>(x0), 1e-14);
  }
  // Stiffness 1 on the left and 4 on the right.
  const TurningPoints found = on("x", "u*((x/a)^2*5/4 + 3/4*(x/a)*abs(x/a))", 0.5, 0.25);
  expect_within(found.period, pi_v<long double> * 1.5L, 1e-12);
}

TEST(OscillationPeriod, OfAKinkThatIsNotADoubleIsEnclosed) {
  const TurningPoints found = on("x", "u*abs(x/a - 1/3)", 1, 0);
  expect_within(found.period, 4 * std::sqrt(4.0L / 3), 1e-11);
}

TEST(OscillationPeriod, FeelsANarrowWell) {
  // Between walls that are steep, a square well nearly: the time in the well of depth 24 and width 2 w.
  const TurningPoints with = on("x", "u*((x/a)^2/2 - 24/(1 + (4096*x/a)^2))", 1, 0);
  const TurningPoints without = on("x", "u*(x/a)^2/2", 1, 0);
  ASSERT_TRUE(with.period.value);
  expect_within(without.period, 2 * pi_v<long double>, 1e-13);
  EXPECT_LT(*with.period.value, *without.period.value - 1e-3);
  EXPECT_LT(with.period.error, 1e-11);
}

TEST(OscillationPeriod, FastHarmonicsBeyondTheWorkAllowedLeaveALargeErrorOrNone) {
  const TurningPoints found = on("theta", "u*cos(3000*theta)", 0, 2.25);
  const long double expected = turn(2 + 2.25L * 2.25L / 2, 2.25L * 2.25L / 2);
  if (found.period.value) {
    EXPECT_LE(std::abs(*found.period.value - expected), found.period.error);
  } else {
    EXPECT_FALSE(found.period.reason.empty());
  }
}

TEST(TurningPoints, BeyondAKinkAreThoseOfTheOtherSide) {
  // x^2/2 - 2 |x| has the same value at 2 + d and 2 - d; from 4.5 the motion passes the kink.
  for (const double x0 : {3.0, 3.5, 3.75, 3.984375}) {
    const TurningPoints inner = on("x", "u*((x/a)^2/2 - 2*abs(x/a))", x0, 0);
    expect_within(inner.minimum, 4 - static_cast<long double>(x0), 1e-13);
    expect_within(inner.period, 2 * pi_v<long double>, 1e-12);
  }
  const TurningPoints outer = on("x", "u*((x/a)^2/2 - 2*abs(x/a))", 4.5, 0);
  expect_within(outer.minimum, -4.5L, 1e-14);
}

TEST(TurningPoints, AtAJumpOfThePotentialAreAtTheJump) {
  const TurningPoints found = on("x", "u*((x/a)^2/2 + 5*sign(x/a - 1))", 0, 0.5);
  expect_within(found.maximum, 0.5L, 1e-14);
  const TurningPoints wall = on("x", "u*((x/a)^2/2 + 5*sign(x/a - 1))", 0, 2);
  expect_within(wall.maximum, 1, 1e-14);
  EXPECT_FALSE(wall.period.value && wall.period.error < 1e-3);
}

TEST(TurningPoints, BeforeAThinWallAreNotBehindIt) {
  for (const double width : {0.25, 0x1p-10, 0x1p-20}) {
    const std::string wall = "u*10/(1 + ((x/a - 5)*" + std::to_string(std::lround(1 / width)) + ")^2)";
    const TurningPoints found = on("x", wall, 0, 1);  // h = 1/2 + V(0): 10/(1 + y^2) = h
    const long double start = 10 / (1 + 25.0L / (static_cast<long double>(width) * width));
    const long double y = std::sqrt(10 / (0.5L + start) - 1);
    expect_within(found.maximum, 5 - y * width, 1e-12);
    EXPECT_EQ(found.motion, MotionKind::unbounded);
  }
}

TEST(TurningPoints, OfRestAtAKinkAreTheKinkWithItsStability) {
  const TurningPoints corner = on("x", "u*(abs(x/a) + x/a/2)", 0, 0);
  EXPECT_EQ(corner.motion, MotionKind::equilibrium);
  EXPECT_EQ(corner.stability, "stable");
  const TurningPoints ridge = on("x", "u*((x/a)^2/2 - 2*abs(x/a))", 0, 0);
  EXPECT_EQ(ridge.motion, MotionKind::equilibrium);
  EXPECT_EQ(ridge.stability, "unstable");
  const TurningPoints slope = on("x", "u*(x^2/a^2 + 2*x/a + abs(x/a))", 0, 0);  // both slopes point down
  EXPECT_EQ(slope.motion, MotionKind::libration);
  expect_within(slope.minimum, -1, 1e-13);
  EXPECT_EQ(*slope.maximum.value, 0);
}

TEST(TurningPoints, FromRestALastDigitBesideAnUnstableEquilibriumAreFarAway) {
  const struct {
    double start, other;
    std::string zeros;
  } cases[] = {
      {0.25, 1.25, "(x/a - 1.25)*(x/a - 0.25)*(x/a - 0.24999999999999994448884876874217)"},
      {1.25, 2.25, "(x/a - 2.25)*(x/a - 1.25)*(x/a - 1.24999999999999977795539507496869)"},
      {1000.25, 1001.25, "(x/a - 1001.25)*(x/a - 1000.25)*(x/a - 1000.2499999999998863131622783839702606)"}};
  for (const auto& [start, other, zeros] : cases) {
    const TurningPoints found = on("x", "u*" + zeros, start, 0);
    EXPECT_EQ(found.motion, MotionKind::libration);
    expect_within(found.maximum, other, 1e-12);
    EXPECT_EQ(*found.minimum.value, start);
  }
}

}  // namespace
}  // namespace qdot
