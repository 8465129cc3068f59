// How motions end: slack strings, lift-off, singular coordinates, and what is refused at the start.

#include "core/motion/simulation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/motions.hpp"

namespace qdot {
namespace {

using test::instants;
using test::row;

/// The whirled string, drawn back so hard that it goes slack on the inner side.
const Values going_slack{{"m", 0.5}, {"l", 0.5}, {"r", 1}, {"omega0", 2}, {"phi", 2}, {"phi_dot", 0}};

Simulation with_tension(const Values& given, double t_end, OnInvalid on_invalid) {
  const auto model = test::model_of("orbiting_pendulum");
  SimulationRequest request = test::request_for(*model, given, instants(t_end, 100));
  request.columns = validity_columns(*model);
  request.on_invalid = on_invalid;
  return simulate(Dynamics(model), request);
}

TEST(SlackString, EndsTheMotionWhereTheTensionVanishes) {
  const Simulation motion = with_tension(going_slack, 1, OnInvalid::stop);
  ASSERT_TRUE(motion.stop.has_value());
  EXPECT_EQ(motion.ending, Ending::event);
  EXPECT_EQ(motion.stop->reason, "string_slack");
  EXPECT_EQ(motion.stop->message, "The string goes slack: its tension has fallen to zero.");
  EXPECT_EQ(motion.stop->t, motion.t);
  const double tension =  // m [l (w + phi')^2 + r w^2 cos phi]
      0.5 * (0.5 * std::pow(2 + motion.y[1], 2) + 4 * std::cos(motion.y[0]));
  EXPECT_NEAR(tension, 0, 1e-12);
}

TEST(SlackString, LeavesTheRowsBeforeItsEnd) {
  const Simulation motion = with_tension(going_slack, 1, OnInvalid::stop);
  const std::vector<double> grid = instants(1, 100);
  ASSERT_GT(motion.rows, 1u);
  ASSERT_LT(motion.rows, grid.size());
  EXPECT_LE(grid[motion.rows - 1], motion.t);
  EXPECT_GT(grid[motion.rows], motion.t);
  ASSERT_EQ(motion.columns.size(), motion.rows);
  for (const double tension : motion.columns) EXPECT_GE(tension, 0);
}

TEST(SlackString, IsSeenInTheColumnWhereTheMotionGoesOn) {
  const Simulation motion = with_tension(going_slack, 1, OnInvalid::go_on);
  EXPECT_EQ(motion.rows, 101u);
  EXPECT_FALSE(motion.stop.has_value());
  EXPECT_LT(*std::min_element(motion.columns.begin(), motion.columns.end()), 0);
}

TEST(SlackString, AtTheStartIsTheOnlyRow) {
  Values slack = going_slack;
  slack["phi"] = 3;
  slack["phi_dot"] = -2;
  const Simulation motion = with_tension(slack, 1, OnInvalid::stop);
  ASSERT_TRUE(motion.stop.has_value());
  EXPECT_EQ(motion.stop->reason, "string_slack");
  EXPECT_EQ(motion.t, 0);
  EXPECT_EQ(motion.rows, 1u);
  EXPECT_EQ(motion.states, motion.y);
}

/// The friction turns the disk: f = -m q''/2.
TEST(RollingDisk, ReportsTheFrictionThatRollingAsksFor) {
  const auto model = test::model_of("rolling_disk_platform");
  const double m = 2.5, W = -0.7, g = 9.81, q = 0.4, v = 1.2, t = 0.3;
  const std::vector<double> parameters =
      parameter_values(*model, {{"m", m}, {"r", 0.15}, {"Omega", W}, {"g", g}});
  const std::vector<double> friction =
      values_at(Dynamics(model), report_columns(*model), parameters, t, std::vector<double>{q, v});
  ASSERT_EQ(friction.size(), 1u);
  EXPECT_NEAR(friction[0], -m / 2 * 2.0 / 3 * (W * W * q - g * std::sin(W * t)), 1e-14);
}

/// N = m (g cos Omega t + 2 Omega q' - r Omega^2) with q from the closed form.
TEST(RollingDisk, LiftsOffWhereTheNormalForceVanishes) {
  const double r = 0.15, W = 0.4, g = 9.81, q0 = 0.5, v0 = 2;
  const Values given{{"m", 2.5}, {"r", r}, {"Omega", W}, {"g", g}, {"q", q0}, {"q_dot", v0}};
  const Simulation motion = test::motion_of("rolling_disk_platform", given, {0, 5});
  ASSERT_TRUE(motion.stop.has_value());
  EXPECT_EQ(motion.stop->reason, "lift_off");
  const double lambda = std::sqrt(2.0 / 3) * W, C = 2 * g / (5 * W * W), t = motion.t;
  const double velocity =
      q0 * lambda * std::sinh(lambda * t) + (v0 - C * W) * std::cosh(lambda * t) + C * W * std::cos(W * t);
  EXPECT_NEAR(g * std::cos(W * t) + 2 * W * velocity - r * W * W, 0, 1e-10);
}

TEST(RollingDisk, DoesNotLieOnAPlatformThatThrowsItOff) {
  const Values given{{"m", 2.5}, {"r", 0.15}, {"Omega", 1.7}, {"g", 0}, {"q", 0.5}, {"q_dot", -0.4}};
  const Simulation motion = test::motion_of("rolling_disk_platform", given, {0, 1});
  ASSERT_TRUE(motion.stop.has_value());
  EXPECT_EQ(motion.stop->reason, "lift_off");
  EXPECT_EQ(motion.stop->t, 0);
}

/// Without gravity and rest length the spring pendulum is an oscillator: l = cos(sqrt(k/m) t).
TEST(CoordinateSingularity, EndsTheSpringPendulumAtItsPivot) {
  const Values given{{"m", 1}, {"k", 4}, {"l0", 0}, {"g", 0}, {"l", 1}, {"theta", 0}};
  const Simulation motion = test::motion_of("spring_pendulum", given, {0, 5});
  ASSERT_TRUE(motion.stop.has_value());
  EXPECT_EQ(motion.stop->reason, "coordinate_singularity");
  EXPECT_NEAR(motion.t, std::acos(0) / 2, 1e-10);
}

TEST(CoordinateSingularity, IsPassedByThePendulumThatHasAngularMomentum) {
  const Values given{{"m", 1}, {"k", 4}, {"l0", 0}, {"g", 0}, {"l", 1}, {"theta", 0}, {"theta_dot", 1e-3}};
  const Simulation motion = test::motion_of("spring_pendulum", given, {0, 2});
  EXPECT_FALSE(motion.stop.has_value());
  EXPECT_NEAR(motion.y[0], std::hypot(std::cos(4.0), 5e-4 * std::sin(4.0)), 1e-9);  // the ellipse's radius
}

TEST(CoordinateSingularity, EndsTheFreeSpinPendulumOnItsAxis) {
  const Values given{{"theta", 1}, {"psi_dot", 0}};
  const Simulation motion = test::motion_of("free_spin_pendulum", given, {0, 5});
  ASSERT_TRUE(motion.stop.has_value());
  EXPECT_EQ(motion.stop->reason, "coordinate_singularity");
  EXPECT_EQ(motion.stop->message, "The bob is on the vertical axis, where the angle psi is not defined.");
  EXPECT_NEAR(std::sin(motion.y[0]), -0.5, 1e-10);
}

TEST(InitialState, OutsideItsCoordinatesIsRefused) {
  const auto code = [](const std::string& system, const Values& given) {
    try {
      (void)test::motion_of(system, given, {0, 1});
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::syntax;  // not refused
  };
  EXPECT_EQ(code("spring_pendulum", {{"l", 0}}), ErrorCode::invalid_state);
  EXPECT_EQ(code("spring_pendulum", {{"l", -0.5}}), ErrorCode::invalid_state);
  EXPECT_EQ(code("rod_spring_pendulum", {{"r", 0}}), ErrorCode::invalid_state);
  EXPECT_EQ(code("spherical_pendulum", {{"theta", 0}}), ErrorCode::invalid_state);
}

TEST(Simulation, FillsColumnsForEveryRow) {
  const auto model = test::model_of("spring_pendulum");
  SimulationRequest request = test::request_for(*model, {}, instants(3, 30));
  request.columns = position_columns(*model);
  ASSERT_EQ(request.columns.size(), 4u);
  EXPECT_EQ(request.columns[2].name, "bob_x");
  const Simulation motion = simulate(Dynamics(model), request);
  ASSERT_EQ(motion.columns.size(), 31u * 4);
  for (std::size_t i = 0; i < motion.rows; ++i) {
    EXPECT_DOUBLE_EQ(motion.columns[4 * i + 2], row(motion, i)[0] * std::sin(row(motion, i)[1]));
    EXPECT_DOUBLE_EQ(motion.columns[4 * i + 3], -row(motion, i)[0] * std::cos(row(motion, i)[1]));
  }
}

TEST(Simulation, ConservesMoreWhereAParameterVanishes) {
  const auto names = [](const Values& given) {
    std::vector<std::string> found;
    for (const ConservedRecord& record :
         test::motion_of("spring_pendulum", given, instants(10, 10)).conserved) {
      EXPECT_LT(record.max_abs_drift, 1e-10) << record.name;
      found.push_back(record.name);
    }
    return found;
  };
  EXPECT_EQ(names({}), std::vector<std::string>{"energy"});
  EXPECT_EQ(names({{"g", 0}, {"theta_dot", 2}}), (std::vector<std::string>{"energy", "p_theta"}));
}

TEST(Simulation, ReportsTheDriftOfItsRows) {
  const auto model = test::model_of("rod_pendulum");
  SimulationRequest request = test::request_for(*model, {}, instants(5, 50));
  request.method = Method::adams;
  request.tolerances = {1e-4, 1e-6};  // coarse, so that there is a drift
  request.columns = {{"energy", "J", *model->energy}};
  const Simulation motion = simulate(Dynamics(model), request);
  ASSERT_EQ(motion.conserved.size(), 1u);
  double drift = 0;
  for (const double energy : motion.columns) drift = std::max(drift, std::abs(energy - motion.columns[0]));
  EXPECT_GT(drift, 1e-8);
  EXPECT_NEAR(motion.conserved[0].max_abs_drift, drift, 1e-14);
  EXPECT_NEAR(*motion.conserved[0].max_rel_drift, drift / std::abs(motion.columns[0]), 1e-13);
}

TEST(Simulation, RepeatsItselfBitForBit) {
  const Simulation first = test::motion_of("rod_pendulum", {}, instants(2, 20));
  const Simulation second = test::motion_of("rod_pendulum", {}, instants(2, 20));
  EXPECT_EQ(first.states, second.states);
  EXPECT_EQ(first.evaluations, second.evaluations);
}

TEST(Reference, HasBoundsOfAccelerationsAroundEachRow) {
  const auto model = test::model_of("spring_pendulum");
  const Dynamics dynamics(model);
  SimulationRequest request = test::request_for(*model, {}, instants(5, 100));
  request.method = Method::taylor;
  EXPECT_TRUE(simulate(dynamics, request).accelerations.empty());
  request.is_reference = true;
  const Simulation motion = simulate(dynamics, request);
  ASSERT_EQ(motion.accelerations.size(), motion.rows * 2);
  Workspace workspace = dynamics.accelerations().bind(request.parameters);
  std::vector<double> largest(2), bound(2), a(2);
  EXPECT_TRUE(std::isnan(motion.accelerations[0]));  // before the first step
  for (std::size_t i = 1; i < motion.rows; ++i) {
    const auto y = std::span(motion.states).subspan(i * 4, 4);
    ASSERT_EQ(dynamics.accelerations().evaluate(request.grid[i], y, workspace, a), Evaluation::ok);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_LE(std::abs(a[k]), motion.accelerations[i * 2 + k] * (1 + 1e-9)) << request.grid[i];
      largest[k] = std::max(largest[k], std::abs(a[k]));
      bound[k] = std::max(bound[k], motion.accelerations[i * 2 + k]);
    }
  }
  for (std::size_t k = 0; k < 2; ++k) EXPECT_LT(bound[k], 50 * largest[k]);
}

/// A level that is near at t = 0 beside what the event is later, when the step is long.
TEST(Events, AreSeenSoonAfterTheStart) {
  const auto model = test::mass_under("-5.158*F");
  SimulationRequest request = test::request_for(*model, {{"x", 0.3066}, {"x_dot", 3.654}}, {0, 8.145});
  request.method = Method::taylor;
  request.tolerances = {1e-9, 1e-12};
  for (const std::string power : {"1", "3", "5"}) {
    request.events = {"(x - 0.414901*L)^" + power + " = 0"};
    const Simulation motion = simulate(Dynamics(model), request);
    ASSERT_EQ(motion.events.size(), 2u) << power;
    EXPECT_NEAR(motion.events[0].t, 0.030286435301899506, 1e-14) << power;
  }
}

}  // namespace
}  // namespace qdot
