// The compass walker's stride: swing, scuff, heel strike, and the gaits that repeat.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/motions.hpp"

namespace qdot {
namespace {

using test::row;

/// A gait as the state just after heel strike and its time to the next, for massless feet on a slope of
/// 0.009; time in units of sqrt(l/g).
struct Gait {
  double theta, theta_dot, step_time;

  [[nodiscard]] Values start() const {
    return {{"l", 1},
            {"g", 1},
            {"theta", theta},
            {"phi", 2 * theta},
            {"theta_dot", theta_dot},
            {"phi_dot", (1 - std::cos(2 * theta)) * theta_dot}};
  }
};
const Gait long_gait{0.200310900544247089, -0.199832473004952355, 3.88246375285137414};
const Gait short_gait{0.193937369810181809, -0.203866927442006927, 3.09610586807816370};

/// An error of 1e-13 a stride in the state; a gait's multipliers make at most four of it.
constexpr double one_stride = 1e-11;

Simulation walk(const Values& given, std::vector<double> grid, std::vector<std::string> events = {}) {
  const auto model = test::model_of("compass_walker");
  SimulationRequest request = test::request_for(*model, given, std::move(grid));
  request.events = std::move(events);
  return simulate(Dynamics(model), request);
}

class RepeatingGait : public testing::TestWithParam<Gait> {};
INSTANTIATE_TEST_SUITE_P(Garcia1998, RepeatingGait, testing::Values(long_gait, short_gait),
                         [](const auto& info) { return info.index == 0 ? "long" : "short"; });

TEST_P(RepeatingGait, IsInTheSameStateOneStrideLater) {
  const double T = GetParam().step_time;
  const Simulation gait = walk(GetParam().start(), {0, 0.5, T / 2, T + 0.5, 1.5 * T});
  ASSERT_EQ(gait.rows, 5u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(row(gait, 3)[k], row(gait, 1)[k], one_stride) << k;
    EXPECT_NEAR(row(gait, 4)[k], row(gait, 2)[k], one_stride) << k;
  }
}

TEST_P(RepeatingGait, StrikesWithItsHeelAtItsStepTime) {
  const Simulation gait = walk(GetParam().start(), {0, 2.5 * GetParam().step_time}, {"heel_strike"});
  ASSERT_EQ(gait.events.size(), 2u);
  EXPECT_NEAR(gait.events[0].t, GetParam().step_time, one_stride);
  EXPECT_NEAR(gait.events[1].t - gait.events[0].t, GetParam().step_time, 10 * one_stride);
  EXPECT_NEAR(gait.events[0].y[0], -GetParam().theta, one_stride);  // before the impact
  EXPECT_NEAR(gait.events[0].y[1], -2 * GetParam().theta, one_stride);
}

TEST(CompassWalker, TakesTheSameStrideWithOtherLegsAndGravity) {
  const double unit = std::sqrt(0.7 / 9.81);
  Values given = long_gait.start();
  given["l"] = 0.7;
  given["g"] = 9.81;
  for (const char* rate : {"theta_dot", "phi_dot"}) given[rate] /= unit;
  const Simulation gait = walk(given, {0, 4 * unit});
  ASSERT_EQ(gait.events.size(), 1u);
  EXPECT_NEAR(gait.events[0].t / unit, long_gait.step_time, one_stride);
}

/// |multipliers| = 0.589: what is left after 20 strides is 0.589^20 = 2.5e-5 of the push, up to the shape of
/// the eigenvectors.
TEST(CompassWalker, ForgetsASmallPushOnTheLongGait) {
  Values pushed = long_gait.start();
  pushed["theta_dot"] -= 1e-4;
  const Simulation gait = walk(pushed, {0, 21.5 * long_gait.step_time});
  ASSERT_EQ(gait.events.size(), 21u);
  EXPECT_NEAR(gait.events[20].y[0], -long_gait.theta, 1e-7);
  EXPECT_NEAR(gait.events[20].y[1], -2 * long_gait.theta, 1e-7);
}

TEST(CompassWalker, DoesNotTakeScuffingForAStrike) {
  const Simulation gait = walk(long_gait.start(), {0, 1.2 * long_gait.step_time}, {"scuff"});
  ASSERT_EQ(gait.events.size(), 2u);
  EXPECT_EQ(gait.events[0].name, "scuff");
  EXPECT_EQ(gait.events[1].name, "heel_strike");
  EXPECT_LT(gait.events[0].t, gait.events[1].t - 0.5);
  EXPECT_NEAR(gait.events[0].y[1], 2 * gait.events[0].y[0], 1e-12);  // the foot is on the slope there too
}

TEST(CompassWalker, DoesNotStrikeBeforeItsStanceLegIsUpright) {
  const Values given{{"l", 1},      {"g", 1},         {"theta", 0.2},
                     {"phi", 0.39}, {"theta_dot", 0}, {"phi_dot", 0.5}};  // the foot rises through the slope
  const Simulation swing = walk(given, {0, 0.1}, {"phi - 2*theta = 0+"});
  ASSERT_EQ(swing.events.size(), 1u);
  EXPECT_EQ(swing.events[0].name, "phi - 2*theta = 0+");
  EXPECT_GT(swing.y[0], 0);  // no impact has turned the leg over
}

TEST(CompassWalker, SwingsOnWhereImpactsAreIgnored) {
  const auto model = test::model_of("compass_walker");
  const double beyond = 1.2 * long_gait.step_time;
  SimulationRequest request = test::request_for(*model, long_gait.start(), {0, beyond});
  request.impacts = Impacts::ignore;
  request.events = {"heel_strike"};
  const Simulation swing = simulate(Dynamics(model), request);
  ASSERT_EQ(swing.events.size(), 1u);
  EXPECT_NEAR(swing.events[0].t, long_gait.step_time, one_stride);
  EXPECT_LT(swing.y[0], -long_gait.theta);  // the same leg, on and on
}

TEST(CompassWalker, AppliesTheImpactsMapWithMassiveFeet) {
  const double mu = 0.1;
  const auto model = test::model_of("compass_walker");
  const Values given{{"m", mu},           {"l", 1},      {"g", 1}, {"theta", -0.2}, {"phi", -0.41},
                     {"theta_dot", -0.3}, {"phi_dot", 0}};  // the foot about to strike
  const SimulationRequest request = test::request_for(*model, given, test::instants(0.02, 2000));
  const Simulation walk = simulate(Dynamics(model), request);
  ASSERT_EQ(walk.events.size(), 1u);
  const EventRecord& strike = walk.events[0];
  const auto after = std::upper_bound(request.grid.begin(), request.grid.end(), strike.t);
  ASSERT_NE(after, request.grid.end());
  const auto i = static_cast<std::size_t>(after - request.grid.begin());
  const double theta = strike.y[0], wait = *after - strike.t;
  const double theta_dot = std::cos(2 * theta) * strike.y[2] / (1 + mu * std::pow(std::sin(2 * theta), 2));
  const double phi_dot = (1 - std::cos(2 * theta)) * theta_dot;
  const double coasting = 10 * wait * wait + 1e-12;  // the accelerations act until the next row
  EXPECT_NEAR(row(walk, i)[0], -theta + wait * theta_dot, coasting);
  EXPECT_NEAR(row(walk, i)[1], -2 * theta + wait * phi_dot, coasting);
}

TEST(CompassWalker, StopsAfterAsManyStridesAsItIsAskedFor) {
  const auto model = test::model_of("compass_walker");
  SimulationRequest request = test::request_for(*model, long_gait.start(), {0, 1, 4, 100});
  request.end_after_impacts = 3;
  const Simulation walk = simulate(Dynamics(model), request);
  EXPECT_EQ(walk.ending, Ending::reached_end);
  EXPECT_FALSE(walk.stop.has_value());
  EXPECT_EQ(walk.rows, 3u);  // the third stride ends before 100
  ASSERT_EQ(walk.sections.size(), 3u);
  EXPECT_EQ(walk.t, walk.sections.back().t);
  EXPECT_EQ(walk.y, walk.sections.back().before);
  double t = 0;
  for (const SectionRecord& stride : walk.sections) {
    EXPECT_DOUBLE_EQ(stride.t - t, stride.duration);
    EXPECT_NEAR(stride.duration, long_gait.step_time, 10 * one_stride);
    EXPECT_NEAR(stride.before[0], -long_gait.theta, 10 * one_stride);
    EXPECT_NEAR(stride.after[0], long_gait.theta, 10 * one_stride);
    EXPECT_NEAR(stride.after[2], long_gait.theta_dot, 10 * one_stride);
    t = stride.t;
  }
}

TEST(CompassWalker, TellsItsStridesWithoutBeingAsked) {
  const Simulation gait = walk(long_gait.start(), {0, 2.5 * long_gait.step_time});
  EXPECT_EQ(gait.sections.size(), 2u);
  EXPECT_EQ(gait.t, 2.5 * long_gait.step_time);
}

/// An impact at t_end itself ends a stride, though no motion follows it.
TEST(CompassWalker, TellsTheStrideThatEndsWithTheMotion) {
  const auto model = test::model_of("compass_walker");
  SimulationRequest request = test::request_for(*model, long_gait.start(), {0, 100});
  request.end_after_impacts = 1;
  const double strike = simulate(Dynamics(model), request).t;
  request.end_after_impacts.reset();
  request.t_end = std::nextafter(strike, 100.);
  request.grid = {0, request.t_end};
  const Simulation gait = simulate(Dynamics(model), request);
  EXPECT_EQ(gait.ending, Ending::reached_end);
  EXPECT_LE(gait.sections.size(), 1u);
  EXPECT_NEAR(gait.t, strike, 1e-12);
}

TEST(CompassWalker, FallsBeforeItsLastStride) {
  Values given = long_gait.start();
  given["theta_dot"] = -0.15;
  const auto model = test::model_of("compass_walker");
  SimulationRequest request = test::request_for(*model, given, {0, 100});
  request.end_after_impacts = 5;
  const Simulation fall = simulate(Dynamics(model), request);
  ASSERT_TRUE(fall.stop.has_value());
  EXPECT_EQ(fall.stop->reason, "fall");
  EXPECT_LT(fall.sections.size(), 5u);
}

TEST(CompassWalker, FallsWhenItIsTooSlow) {
  Values given = long_gait.start();
  given["theta_dot"] = 0;
  given["phi_dot"] = 0;
  const Simulation fall = walk(given, {0, 100});
  ASSERT_TRUE(fall.stop.has_value());
  EXPECT_EQ(fall.stop->reason, "fall");
  EXPECT_EQ(fall.ending, Ending::event);
  EXPECT_NEAR(std::abs(fall.y[0]), std::acos(0), 1e-12);  // the stance leg lies on the slope
}

}  // namespace
}  // namespace qdot
