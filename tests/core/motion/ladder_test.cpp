// The measured error is the true one, within its factor.

#include "core/motion/ladder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/motion/motion_check.hpp"
#include "tests/support/motions.hpp"
#include "tests/support/system_test.hpp"

namespace qdot {
namespace {

using Kind = AccuracyGoal::Kind;

/// x = x0 cos(w t): the isotropic oscillator that the spring pendulum is for l0 = 0, g = 0.
const Values oscillator{{"m", 0.5},  {"k", 8},     {"l0", 0},       {"g", 0},
                        {"l", 1.25}, {"theta", 0}, {"theta_dot", 2}};

/// l(t) of it: l^2 = (x0 cos wt)^2 + (v0/w sin wt)^2.
double exact_length(double t) {
  const double w = 4;
  return std::hypot(1.25 * std::cos(w * t), 2 * 1.25 / w * std::sin(w * t));
}

MeasuredSimulation measured(const Values& given, std::vector<double> grid, const AccuracyGoal& goal,
                            Method method = Method::taylor, Tolerances tolerances = {1e-9, 1e-12}) {
  const auto model = test::model_of("spring_pendulum");
  SimulationRequest request = test::request_for(*model, given, std::move(grid));
  request.method = method;
  request.tolerances = tolerances;
  return simulate_with_error(Dynamics(model), request, goal);
}

double true_error(const MeasuredSimulation& m, std::span<const double> grid) {
  double error = 0;
  for (std::size_t i = 0; i < m.simulation.rows; ++i) {
    error = std::max(error, std::abs(test::row(m.simulation, i)[0] - exact_length(grid[i])));
  }
  return error;
}

TEST(Ladder, MeasuresTheErrorOfEveryMethodAtEveryTolerance) {
  const std::vector<double> grid = test::instants(50, 100);
  for (const Method method : test::all_methods) {
    for (const double rtol : {1e-4, 1e-7, 1e-10}) {
      const MeasuredSimulation m = measured(oscillator, grid, {}, method, {rtol, rtol / 100});
      ASSERT_EQ(m.max_abs_error.size(), 4U) << static_cast<int>(method) << " " << rtol;
      const double error = true_error(m, grid);
      EXPECT_LE(error, m.max_abs_error[0]) << static_cast<int>(method) << " " << rtol;
      EXPECT_LE(m.max_abs_error[0], 10 * error) << static_cast<int>(method) << " " << rtol;
    }
  }
}

TEST(Ladder, MeetsAWantedError) {
  const std::vector<double> grid = test::instants(50, 100);
  for (double wanted = 1e-2; wanted > 1e-12; wanted /= 10) {
    const MeasuredSimulation m = measured(oscillator, grid, {.kind = Kind::absolute, .value = wanted});
    EXPECT_EQ(m.meets_request, true) << wanted;
    EXPECT_LE(true_error(m, grid), wanted);
    for (const double e : m.max_abs_error) EXPECT_LE(e, wanted);
  }
}

/// Of a request to the whole motion, whatever the scene's conditions say.
SimulationRequest whole_motion(const Model& model, const Values& given, double t_end) {
  SimulationRequest request = test::request_for(model, given, test::instants(t_end, 200));
  request.method = Method::taylor;
  request.on_invalid = OnInvalid::go_on;
  return request;
}

std::uint64_t work_at(const Dynamics& dynamics, SimulationRequest request, double rtol) {
  request.tolerances = {rtol, rtol * 1e-3};
  return simulate_with_error(dynamics, request, {}).evaluations;
}

TEST(Ladder, ACheckIsGivenUpOnceTheErrorWantedIsPassed) {
  const auto model = test::model_of("rod_pendulum");
  const Dynamics dynamics(model);
  const SimulationRequest request = whole_motion(*model, {{"theta", 0.3}, {"phi", -0.2}}, 100);
  const MeasuredSimulation m =
      simulate_with_error(dynamics, request, {.kind = Kind::relative, .value = 1e-3});
  EXPECT_EQ(m.meets_request, true);
  EXPECT_LT(m.tolerances.rtol, 1e-6);  // that of the first run, which does not meet it
  const std::uint64_t first = work_at(dynamics, request, 1e-6);
  EXPECT_LT(m.evaluations, work_at(dynamics, request, m.tolerances.rtol) + first * 3 / 4);
}

TEST(Ladder, AMotionWhoseCheckTakesDoubleDoublesIsNotChosenByAGuess) {
  const auto model = test::model_of("rod_pendulum");
  const Dynamics dynamics(model);
  const SimulationRequest request = whole_motion(*model, {{"m", 1}, {"l", 1}, {"theta", 2}, {"phi", 2}}, 10);
  const MeasuredSimulation m =
      simulate_with_error(dynamics, request, {.kind = Kind::relative, .value = 1e-6});
  EXPECT_EQ(m.meets_request, true);
  EXPECT_LT(m.tolerances.rtol, 1e-12);
  EXPECT_EQ(m.evaluations, work_at(dynamics, request, 1e-9) + work_at(dynamics, request, m.tolerances.rtol));
}

TEST(Ladder, RowsAtEventsDoNotMakeACheckGiveUp) {
  const auto model = test::model_of("rod_pendulum");
  const Dynamics dynamics(model);
  SimulationRequest request = whole_motion(*model, {{"theta", 0.3}, {"phi", -0.2}}, 100);
  const AccuracyGoal goal{.kind = Kind::relative, .value = 1e-3};
  const MeasuredSimulation without = simulate_with_error(dynamics, request, goal);
  request.events = {"theta = 0"};
  const MeasuredSimulation with = simulate_with_error(dynamics, request, goal);
  EXPECT_GT(with.simulation.events.size(), 50U);
  EXPECT_EQ(with.tolerances.rtol, without.tolerances.rtol);
  EXPECT_EQ(with.max_abs_error, without.max_abs_error);
}

TEST(Ladder, WhatWasGivenUpIsTheBestFoundWhereNothingTighterIs) {
  const auto model = test::model_of("rod_pendulum");
  const Dynamics dynamics(model);
  SimulationRequest request = whole_motion(*model, {{"theta", 0.3}, {"phi", -0.2}}, 100);
  request.limits.max_steps = 1700;  // enough for 1e-6, and not for what comes next
  const MeasuredSimulation m =
      simulate_with_error(dynamics, request, {.kind = Kind::relative, .value = 1e-3});
  EXPECT_EQ(m.meets_request, false);
  EXPECT_EQ(m.tolerances.rtol, 1e-6);
}

TEST(Ladder, ALooserRunIsMeasuredWhereRoundingHidesTheErrorOfATighterOne) {
  const auto model = test::model_of("cart_pendulum");
  const Dynamics dynamics(model);
  SimulationRequest request = whole_motion(*model, {}, 20);
  const MeasuredSimulation m =
      simulate_with_error(dynamics, request, {.kind = Kind::relative, .value = 1e-9});
  EXPECT_EQ(m.meets_request, true);
  EXPECT_GT(m.tolerances.rtol, 1e-11);
  EXPECT_LT(m.evaluations, work_at(dynamics, request, 2e-12) / 2);
  request.tolerances = {1e-15, 1e-18};
  const Simulation best = simulate(dynamics, request);
  for (std::size_t k = 0; k < 4; ++k) {
    double error = 0;
    for (std::size_t i = 0; i < best.rows; ++i)
      error = std::max(error, std::abs(test::row(m.simulation, i)[k] - test::row(best, i)[k]));
    EXPECT_LE(error, m.max_abs_error[k]);
    EXPECT_GT(error, m.max_abs_error[k] / 10);
  }
}

/// Here the motion's own energy happens to be kept well, and its check's is off by a seventeenth of that.
TEST(Ladder, ACheckWhoseOwnErrorIsInTheErrorStatedNeedsNoMoreDigits) {
  const Values stiff{{"m", 1}, {"k", 1e6}, {"l0", 1}, {"l", 1 + 9.81e-6 + 1e-4}, {"theta", 0.3}};
  const std::vector<double> grid = test::instants(10, 1000);
  const MeasuredSimulation m = measured(stiff, grid, {}, Method::taylor, {1e-8, 1e-11});
  EXPECT_LT(m.evaluations, 3 * m.simulation.evaluations);
  const MeasuredSimulation best = measured(stiff, grid, {.verify = false}, Method::taylor, {1e-15, 1e-18});
  for (std::size_t i = 0; i < grid.size(); ++i) {
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(test::row(m.simulation, i)[k], test::row(best.simulation, i)[k], m.max_abs_error[k]);
  }
}

/// Here bounds hold steps short, and are so rough that a check that meets them loosely may seem to be off by
/// as much as the motion.
TEST(Ladder, ACheckWhoseStepsAreHeldByBoundsIsSharpEnough) {
  const auto model = test::model_of("rod_spring_pendulum");
  const Dynamics dynamics(model);
  SimulationRequest request = whole_motion(*model, {{"theta", 0.7}, {"phi", -0.4}, {"r", 0.6}}, 20);
  request.tolerances = {1e-15, 1e-18};
  const Simulation best = simulate(dynamics, request);
  for (const double wanted : {1e-3, 1e-6}) {
    const MeasuredSimulation m =
        simulate_with_error(dynamics, request, {.kind = Kind::relative, .value = wanted});
    EXPECT_EQ(m.meets_request, true);
    EXPECT_LT(m.evaluations, 3 * m.simulation.evaluations) << wanted;
    for (std::size_t i = 0; i < best.rows; ++i) {
      for (std::size_t k = 0; k < 6; ++k)
        EXPECT_NEAR(test::row(m.simulation, i)[k], test::row(best, i)[k], m.max_abs_error[k]);
    }
  }
}

TEST(Ladder, RowsAtEventsAreOfTheMotionThatIsReturned) {
  const auto model = test::model_of("cart_pendulum");
  const Dynamics dynamics(model);
  SimulationRequest request = whole_motion(*model, {}, 20);
  request.events = {"theta = 0"};
  const MeasuredSimulation m =
      simulate_with_error(dynamics, request, {.kind = Kind::relative, .value = 1e-9});
  ASSERT_GT(m.event_errors.size(), 5U);
  for (const auto& error : m.event_errors) EXPECT_LT(error.value().time, 1e-8);
  EXPECT_LT(m.event_errors.front().value().time, m.event_errors.back().value().time / 15);
}

TEST(Ladder, SaysThatTheWorkWasSpentBeforeTheErrorWasReached) {
  const auto model = test::model_of("spring_pendulum");
  SimulationRequest request = test::request_for(*model, oscillator, test::instants(50, 10));
  request.method = Method::taylor;
  const AccuracyGoal goal{.kind = Kind::absolute, .value = 1e-12};
  const Dynamics dynamics(model);
  request.limits.max_evaluations = simulate_with_error(dynamics, request, goal).evaluations - 1;
  const MeasuredSimulation m = simulate_with_error(dynamics, request, goal);
  EXPECT_EQ(m.meets_request, false);
  EXPECT_THAT(m.reason, ::testing::HasSubstr("spent"));
}

TEST(Ladder, SaysWhatIsOutOfReach) {
  const std::vector<double> grid = test::instants(1000, 10);
  const MeasuredSimulation m = measured(oscillator, grid, {.kind = Kind::absolute, .value = 1e-14});
  EXPECT_EQ(m.meets_request, false);
  EXPECT_FALSE(m.reason.empty());
  EXPECT_LE(true_error(m, grid), m.max_abs_error[0]);
}

/// x'' = -k L sin(x/L) + f L sin(w t) - b x' from zeros, for an L of 1e-15 m. Steps of a tolerance beside 1 m
/// leave the place where sin(x/L) is slow.
TEST(Ladder, AStartOfZerosTellsNothingOfTheUnitAndIsSlowInNone) {
  const auto model =
      test::mass_under("F*(7.11*sin(1.88*t/T) - 5.07*sin(x/L)*(1 + t/T/100)) - 0.288*m*x_dot/T");
  const Dynamics dynamics(model);
  for (const double size : {1.0, 1e-9, 1e-12, 1e-14, 1e-15, 1e-16, 1e-18}) {
    const Values given{{"L", 2.06 * size}, {"F", size}};
    for (const double wanted : {1e-3, 1e-6}) {
      SimulationRequest request = test::request_for(*model, given, {0, 9.7, 19.4});
      request.method = Method::taylor;
      const AccuracyGoal goal{.kind = Kind::relative, .value = wanted};
      const MeasuredSimulation m = simulate_with_error(dynamics, request, goal);
      EXPECT_EQ(m.meets_request, true) << size << " " << m.reason;
      EXPECT_LT(m.evaluations, 150'000U) << size;
    }
  }
}

TEST(Ladder, KeepsToTheWorkAllowed) {
  const std::vector<double> grid = test::instants(50, 100);
  double last = std::numeric_limits<double>::infinity();
  for (const std::uint64_t allowed : {20'000ULL, 60'000ULL, 300'000ULL}) {
    const MeasuredSimulation m = measured(oscillator, grid, {.kind = Kind::work, .evaluations = allowed});
    ASSERT_FALSE(m.max_abs_error.empty()) << allowed;
    EXPECT_LE(m.evaluations, allowed);
    EXPECT_LE(m.max_abs_error[0], last);
    last = m.max_abs_error[0];
  }
}

TEST(Ladder, FewRowsAreMeasuredAtManyInstants) {
  const MeasuredSimulation m = measured(oscillator, {0, 50}, {});
  EXPECT_EQ(m.simulation.rows, 2U);
  EXPECT_EQ(m.simulation.states.size(), 8U);
  EXPECT_LE(true_error(m, std::vector<double>{0, 50}), m.max_abs_error[0]);
}

TEST(Ladder, KnowsHowFarAChaoticMotionCanBeTrusted) {
  const auto model = test::model_of("rod_pendulum");
  SimulationRequest request =
      test::request_for(*model, {{"theta", 2}, {"phi", 2.1}}, test::instants(60, 600));
  request.on_invalid = OnInvalid::go_on;
  request.method = Method::taylor;
  request.tolerances = {1e-9, 1e-12};
  const Dynamics dynamics(model);
  const MeasuredSimulation m = simulate_with_error(dynamics, request, {});
  ASSERT_TRUE(m.horizon.has_value());
  // A motion computed as tightly as can be shows where the first one has gone wrong.
  request.tolerances = {1e-15, 1e-18};
  const Simulation best = simulate(dynamics, request);
  std::size_t first = 0;
  while (std::abs(test::row(best, first)[0] - test::row(m.simulation, first)[0]) < 1e-3 * 6) ++first;
  EXPECT_NEAR(*m.horizon, request.grid[first], 0.2 * request.grid[first]);
}

/// x'' = -(b/m) x' - (k/m) x from (0.2, 0): both rates real, their difference lost in x0 - x(t).
TEST(Ladder, StrongDampingIsLeftToBdf) {
  const double m = 0.5, b = 1e5, k = 8;
  const auto model = test::model_of("damped_oscillator");
  SimulationRequest request =
      test::request_for(*model, {{"m", m}, {"b", b}, {"k", k}, {"x", 0.2}}, test::instants(2e4, 50));
  request.method = Method::taylor;
  const MeasuredSimulation found =
      simulate_with_error(Dynamics(model), request, {.kind = Kind::relative, .value = 1e-6});
  EXPECT_EQ(found.simulation.method, Method::bdf);
  EXPECT_EQ(found.meets_request, false);  // its steps have no bound, so that nothing is promised
  EXPECT_FALSE(found.bounded);
  EXPECT_FALSE(found.reason.empty());
  const double fast = b / m / 2 + std::sqrt(b * b / m / m / 4 - k / m), slow = k / m / fast;
  for (std::size_t i = 0; i < found.simulation.rows; ++i) {
    const double x = 0.2 *
                     (fast * std::exp(-slow * request.grid[i]) - slow * std::exp(-fast * request.grid[i])) /
                     (fast - slow);
    EXPECT_NEAR(test::row(found.simulation, i)[0], x, found.max_abs_error[0]) << request.grid[i];
  }
}

TEST(Ladder, WeakDampingIsNot) {
  const auto model = test::model_of("damped_oscillator");
  SimulationRequest request = test::request_for(*model, {{"b", 1}}, test::instants(50, 50));
  request.method = Method::taylor;
  EXPECT_EQ(simulate_with_error(Dynamics(model), request, {}).simulation.method, Method::taylor);
}

/// A growing motion, whose whole error is one number: a single difference would be small by chance sometimes.
TEST(Ladder, RoundOffIsNotSmallByChance) {
  const auto model = test::model_of("rolling_disk_platform");
  const Dynamics dynamics(model);
  for (int i = 0; i < 60; ++i) {
    // Without gravity q = q0 cosh(s t), s = Omega sqrt(2/3).
    const double Omega = 0.5 + 0.003 * i, s = Omega * std::sqrt(2.0 / 3);
    SimulationRequest request = test::request_for(
        *model, {{"Omega", Omega}, {"g", 0}, {"q", 0.3 + 0.01 * i}, {"q_dot", 0}}, test::instants(60, 7));
    request.on_invalid = OnInvalid::go_on;
    request.method = Method::taylor;
    request.tolerances = {1e-14, 1e-17};
    const MeasuredSimulation m = simulate_with_error(dynamics, request, {});
    const long double rate = std::sqrt(2.0L / 3) * static_cast<long double>(Omega);
    const double end =
        static_cast<double>(static_cast<long double>(request.y_start[0]) * std::cosh(rate * 60));
    EXPECT_NEAR(test::row(m.simulation, 7)[0], end, 3 * m.max_abs_error[0]) << i;
    EXPECT_LT(m.max_abs_error[0], 1e-13 * end * (1 + 60 * s)) << i;
  }
}

/// Moved alike, two numbers near each other would keep their difference.
TEST(Ladder, ChecksMoveNumbersByDifferentAmounts) {
  const auto model = test::model_of("spring_pendulum");
  SimulationRequest request = test::request_for(*model, {}, test::instants(1, 2));
  request.parameters = std::vector<double>(4, 1.0);
  request.y_start = std::vector<double>(4, 1.0);
  const Dynamics dynamics(model);
  const DenseGrid grid(request);
  const Simulation motion = simulate(dynamics, request);
  const SimulationRequest check =
      check_of({dynamics, request, grid, EventRows(grid.t, motion), motion, request.tolerances, false}, 1);
  std::set<double> moved{1.0};
  for (std::size_t i = 0; i < 4; ++i) moved.insert({check.parameters[i], check.y_start[i]});
  EXPECT_EQ(moved.size(), 9U);
}

TEST(Ladder, SkipsTheMeasurementWhenAsked) {
  const MeasuredSimulation m = measured(oscillator, {0, 5}, {.verify = false});
  EXPECT_TRUE(m.max_abs_error.empty());
  EXPECT_EQ(m.evaluations, m.simulation.evaluations);
}

}  // namespace
}  // namespace qdot
