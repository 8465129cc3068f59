// Motions with dry friction and other kinks, against their pieces in closed form.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/motion/ladder.hpp"
#include "tests/support/motions.hpp"

namespace qdot {
namespace {

using test::instants;
using test::mass_under;
using test::row;

MeasuredSimulation measured(const std::string& force, const Values& given, double t_end, int rows,
                            Method method = Method::taylor) {
  const auto model = mass_under(force);
  SimulationRequest request = test::request_for(*model, given, instants(t_end, rows));
  request.method = method;
  request.tolerances = {1e-10, 1e-13};
  request.columns = acceleration_columns(*model);
  return simulate_with_error(Dynamics(model), request, {});
}

/// Every row within the stated error of the truth, x(t) and x'(t).
template <class Truth>
void expect_within(const MeasuredSimulation& found, double t_end, int rows, const Truth& truth) {
  ASSERT_EQ(found.simulation.ending, Ending::reached_end);
  ASSERT_EQ(found.max_abs_error.size(), 2u);
  for (int i = 0; i <= rows; ++i) {
    const auto [x, v] = truth(t_end * i / rows);
    const auto state = row(found.simulation, static_cast<std::size_t>(i));
    EXPECT_LE(std::abs(state[0] - x), found.max_abs_error[0] + 1e-15) << i;
    EXPECT_LE(std::abs(state[1] - v), found.max_abs_error[1] + 1e-15) << i;
  }
  EXPECT_LT(found.max_abs_error[0], 1e-8);
}

struct State {
  double x, v;
};

TEST(DryFriction, BringsAMassToRestAndHoldsIt) {
  for (const Method method : test::all_methods) {
    const auto found = measured("-0.5*F*sign(x_dot)", {{"x_dot", 2}}, 10, 20, method);
    expect_within(found, 10, 20, [](double t) {
      return t < 4 ? State{2 * t - 0.25 * t * t, 2 - 0.5 * t} : State{4, 0};
    });
    EXPECT_EQ(row(found.simulation, 20)[1], 0) << "a mass at rest moves";
    ASSERT_EQ(found.simulation.stays.size(), 1u);
    EXPECT_EQ(found.simulation.stays[0].kink, "x_dot");
    EXPECT_NEAR(found.simulation.stays[0].from, 4, 1e-9);
    EXPECT_EQ(found.simulation.stays[0].to, 10);
    EXPECT_EQ(found.simulation.columns.back(), 0) << "an acceleration at rest";
  }
}

TEST(DryFriction, BoundsItsSteps) {
  EXPECT_TRUE(measured("-0.5*F*sign(x_dot) - F*x/L", {{"x_dot", 2}}, 10, 20).bounded);
}

/// On an incline whose tangent is below the coefficient of friction, or above it.
TEST(DryFriction, HoldsABlockOnAnIncline) {
  const auto held = measured("-4*F - 5*F*sign(x_dot)", {}, 3, 6);
  expect_within(held, 3, 6, [](double) { return State{0, 0}; });
  const auto sliding = measured("-4*F - 3*F*sign(x_dot)", {}, 3, 6);
  expect_within(sliding, 3, 6, [](double t) { return State{-t * t / 2, -t}; });
  EXPECT_TRUE(sliding.simulation.stays.empty());
}

/// It goes when the force has grown to that of friction, at t = asin(1/2).
TEST(DryFriction, LetsGoWhenTheForceIsLargeEnough) {
  const auto found = measured("2*F*sin(t/T) - F*sign(x_dot)", {}, 2, 8);
  const double t0 = std::asin(0.5);
  expect_within(found, 2, 8, [t0](double t) {
    if (t < t0) return State{0, 0};
    const double s = t - t0;
    return State{2 * std::cos(t0) * s - 2 * (std::sin(t) - std::sin(t0)) - s * s / 2,
                 2 * (std::cos(t0) - std::cos(t)) - s};
  });
  ASSERT_FALSE(found.simulation.stays.empty());
  EXPECT_NEAR(found.simulation.stays[0].to, t0, 1e-12);
}

/// On a belt of 1 m/s the mass is carried until the spring pulls harder than friction.
TEST(DryFriction, CarriesABlockOnABelt) {
  const auto found = measured("-4*F*x/L - 2*F*sign(x_dot - L/T)", {{"x_dot", 1}}, 1, 10);
  expect_within(found, 1, 10, [](double t) {
    const double s = t - 0.5;  // then 4 x = 2
    if (s < 0) return State{t, 1};
    return State{0.5 + std::sin(2 * s) / 2, std::cos(2 * s)};
  });
}

/// V = |x|: parabolas, four of them a period of 4 sqrt(2).
TEST(Kinks, OfAPotentialArePassed) {
  const auto found = measured("-F*sign(x)", {{"x", 1}}, 60, 120);
  // In doubles, twenty turns would be off by as much as the motion is.
  const long double quarter = std::numbers::sqrt2_v<long double>;
  expect_within(found, 60, 120, [quarter](double t) {
    const long double turns = std::floor(t / (2 * quarter) + 0.5L);
    const long double s = t - turns * 2 * quarter, side = std::fmod(turns, 2) == 0 ? 1 : -1;
    return State{static_cast<double>(side * (1 - s * s / 2)), static_cast<double>(-side * s)};
  });
  EXPECT_TRUE(found.bounded);
  EXPECT_LT(found.simulation.steps, 200u);
}

TEST(Kinks, HoldWhatRestsOnThem) {
  const auto found = measured("-F*sign(x)", {}, 5, 5);
  expect_within(found, 5, 5, [](double) { return State{0, 0}; });
  ASSERT_EQ(found.simulation.stays.size(), 1u);
}

TEST(Kinks, OfADriveArePassed) {
  const auto found = measured("F*abs(sin(t/T))", {}, 10, 20);
  expect_within(found, 10, 20, [](double t) {
    const double half = std::floor(t / std::numbers::pi), s = t - half * std::numbers::pi;
    const double v = 2 * half + 1 - std::cos(s);
    return State{std::numbers::pi * half * half + s - std::sin(s) + 2 * half * s, v};
  });
  EXPECT_TRUE(found.bounded);
}

/// Of t alone, long after 0: v = arcsin(sin t) + constant.
TEST(Kinks, OfADriveArePassedAtLargeTimes) {
  const auto model = mass_under("F*sign(cos(t/T))");
  SimulationRequest request = test::request_for(*model, {}, {1e8, 1e8 + 4, 1e8 + 9});
  request.t_start = 1e8;
  request.t_end = 1e8 + 9;
  const auto found = simulate_with_error(Dynamics(model), request, {});
  ASSERT_EQ(found.simulation.ending, Ending::reached_end);
  const auto wave = [](long double t) { return std::asin(std::sin(t)); };
  for (std::size_t i = 0; i < 3; ++i) {
    const auto speed = static_cast<double>(wave(request.grid[i]) - wave(1e8L));
    EXPECT_LE(std::abs(row(found.simulation, i)[1] - speed), found.max_abs_error[1]);
  }
  EXPECT_LT(found.max_abs_error[1], 1e-6);
}

/// 2700 last digits of the time apart: where each of them is met moves the next one.
TEST(Kinks, ThatFollowEachOtherWithinTheDigitsOfTheTimeAreToldOf) {
  const auto model = mass_under("F*sign(sin(1e7*t/T + 0.783))");
  SimulationRequest request = test::request_for(*model, {}, {1e6, 1e6 + 4e-6});
  request.t_start = 1e6;
  request.t_end = 1e6 + 4e-6;
  request.method = Method::taylor;
  const auto found = simulate_with_error(Dynamics(model), request, {});
  EXPECT_TRUE(found.max_abs_error.empty());
  EXPECT_NE(found.reason.find("kinks follow each other"), std::string::npos) << found.reason;
}

/// The force may begin at once or never: nothing tells.
TEST(Kinks, ThatPushAwayOnBothSidesAreUndetermined) {
  EXPECT_EQ(measured("F*sign(x_dot)", {}, 5, 5).simulation.ending, Ending::undetermined);
  EXPECT_EQ(measured("F*sign(x_dot)", {{"x_dot", 0.1}}, 5, 5).simulation.ending, Ending::reached_end);
}

/// The oscillation of a mass held by friction and by |x| ends: infinitely many turns in a finite time.
TEST(DryFriction, EndsInfinitelyManyTurns) {
  const auto found = measured("-F*sign(x) - 0.5*F*sign(x_dot)", {{"x", 1}}, 20, 20);
  EXPECT_EQ(found.simulation.ending, Ending::reached_end);
  EXPECT_LT(std::abs(row(found.simulation, 20)[0]), 1e-9);
  EXPECT_LT(std::abs(row(found.simulation, 20)[1]), 1e-9);
}

/// There the last turns are within one instant, and rounding leaves the mass beside both kinks.
TEST(DryFriction, EndsInfinitelyManyTurnsBesideItsKinks) {
  const auto found = measured("0.2*F - 0.562579*F*sign(x) - 0.296963*F*sign(x_dot)",
                              {{"x", 1.7201}, {"x_dot", -0.07596}}, 20, 20);
  EXPECT_EQ(found.simulation.ending, Ending::reached_end);
  EXPECT_EQ(row(found.simulation, 20)[0], 0);
  EXPECT_EQ(row(found.simulation, 20)[1], 0);
}

/// x - L has lost half of its digits. v(2.5) in 20 digits, by its parabolas.
TEST(DryFriction, FarFromTheOriginIsNoMoreCertainThanItsNumbers) {
  const auto found = measured("0.077368*F - 1.409364*F*sign(x - L) - 0.5*F*sign(x_dot)",
                              {{"L", 12345678.9}, {"x", 12345679.0796}, {"x_dot", 0.859}}, 5, 2);
  const double off = std::abs(row(found.simulation, 1)[1] - 0.36935393407996761985);
  EXPECT_GT(off, 1e-9);
  EXPECT_LE(off, found.max_abs_error[1]);
}

/// The mass comes back again and again to the kink at which its section began. Parabolas, x = 1000.2 at rest.
TEST(Kinks, FarFromTheOriginAreMetWhereTheyAre) {
  const auto found = measured("-F*sign(x - 1000.3*L)", {{"x", 1000.2}}, 7, 1);
  const double amplitude = 1000.3 - 1000.2, quarter = std::sqrt(2 * amplitude);
  const double turns = std::floor((7 + quarter) / (2 * quarter)), s = 7 - 2 * quarter * turns;
  const double side = std::fmod(turns, 2) == 0 ? -1 : 1;
  EXPECT_NEAR(row(found.simulation, 1)[0], 1000.3 + side * (amplitude - s * s / 2), 1e-11);
  EXPECT_LE(found.max_abs_error[0], 1e-10);
}

/// Two kinks are met at the same instant, 0.72 s, and one of them soon after that again. By parabolas with 50
/// digits.
TEST(Kinks, MetTogetherAreLeftAtTheirOwnTimes) {
  Scene scene;
  scene.name = "pushed";
  scene.without_units = true;
  scene.coordinates = {Coordinate{"x", "1", "0", "0", {}, {}, {}, {}},
                       Coordinate{"y", "1", "0", "0", {}, {}, {}, {}}};
  scene.lagrangian = "(x_dot^2 + y_dot^2)/2";
  const std::string one = "sign(-0.57*x - 1.99*y + 4.5082)", other = "sign(-1.34*x + 0.49*y + 1.2437)";
  scene.forces = {{.name = "f", .value = "0.98 + 0.67*" + one + " + 0.89*" + other, .along = "x"},
                  {.name = "g", .value = "-0.33 + 0.24*" + one + " + 0.85*" + other, .along = "y"}};
  const auto model = build_model(scene);
  const Values start{{"x", 2.159664}, {"y", 2.874736}, {"x_dot", -0.5824}, {"y_dot", -0.9676}};
  SimulationRequest request = test::request_for(*model, start, {0, 2.29});
  request.method = Method::taylor;
  request.tolerances = {1e-9, 1e-12};
  const MeasuredSimulation found = simulate_with_error(Dynamics(model), request, {});
  ASSERT_EQ(found.max_abs_error.size(), 4u);
  const double end[] = {1.57790717924816186317, -1.879478952403440917197, 0.6217576669305885457904,
                        -3.056503351807864871998};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(row(found.simulation, 1)[k], end[k], found.max_abs_error[k]) << k;
    EXPECT_NEAR(row(found.simulation, 1)[k], end[k], 2e-14) << k;
  }
}

/// A quarter of the oscillation is x = 9 cos t - 5. Each step ends at the kink, and what it may hide is that
/// of the part that was gone.
TEST(Kinks, AreWhereAStepEndsAndWhatItMayHide) {
  const auto model = mass_under("-F*x/L - 5*F*sign(x)");
  SimulationRequest request = test::request_for(*model, {{"x", 4}}, instants(5, 50));
  request.method = Method::taylor;
  request.tolerances = {1e-3, 1e-12};
  const MeasuredSimulation found = simulate_with_error(Dynamics(model), request, {});
  const double quarter = std::acos(5.0 / 9);
  double largest = 0;
  for (int i = 0; i <= 50; ++i) {
    const double turns = std::floor(0.1 * i / (2 * quarter) + 0.5), s = 0.1 * i - turns * 2 * quarter;
    const double x = (std::fmod(turns, 2) == 0 ? 1 : -1) * (9 * std::cos(s) - 5);
    largest = std::max(largest, std::abs(row(found.simulation, static_cast<std::size_t>(i))[0] - x));
  }
  ASSERT_EQ(found.max_abs_error.size(), 2u);
  EXPECT_LE(largest, found.max_abs_error[0]);
  EXPECT_LE(found.max_abs_error[0], 100 * largest + 1e-13);
}

}  // namespace
}  // namespace qdot
