// Events of whole runs: of known motions, at the times that are known.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/integrate/integrate.hpp"
#include "core/numerics/root.hpp"
#include "tests/core/integrate/systems.hpp"

namespace qdot::integrate_events_test {
namespace {

using namespace integrate_test;

constexpr Tolerances tight{1e-13, 1e-14};
constexpr double promised = 1e-10;  // of the time of an event, at tight tolerances over a period or so

TEST(IntegrateEvents, OscillatorCrossesZeroAtOddQuarterPeriods) {
  for (const Method method : all_methods) {
    const auto run = integrated(oscillator(), {.y_start = {1, 0},
                                               .t_end = 10,
                                               .events = {{.value = [](double, auto y) { return y[0]; }}},
                                               .method = method,
                                               .tolerances = tight});
    ASSERT_EQ(run.events.size(), 3u) << name(method);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(run.events[i].t, (i + 0.5) * pi, promised) << name(method);
      EXPECT_NEAR(run.events[i].y[0], 0, 1e-14) << name(method);  // round-off of t times the speed
    }
  }
}

/// Twenty levels, each crossed twice in a period of the oscillator.
RunRequest crossing_levels(double periods) {
  RunRequest request{.y_start = {1, 0}, .t_end = periods * 2 * pi, .method = Method::erk};
  for (int k = 0; k < 20; ++k) {
    const double level = 0.02 * k + 0.01;
    request.events.push_back({.value = [=](double, auto y) { return y[0] - level; },
                              .series =
                                  [=](const MotionPiece& piece, unsigned order, std::span<double> c) {
                                    for (unsigned i = 0; i <= std::min(order, piece.order); ++i)
                                      c[i] = piece.rows[i] - (i == 0 ? level : 0);
                                    double rest = 0;
                                    for (unsigned i = piece.order; i > order; --i)
                                      rest += std::abs(piece.rows[i]) * std::pow(piece.h, i);
                                    return rest;
                                  }});
  }
  return request;
}

TEST(IntegrateEvents, MoreThanAnAnswerHoldsAreRefused) {
  EXPECT_EQ(integrated(oscillator(), crossing_levels(1249)).events.size(), 1249 * 40u);
  EXPECT_THROW((void)integrated(oscillator(), crossing_levels(1251)), Error);
}

TEST(IntegrateEvents, PendulumTurnsAndPassesTheVerticalByEllipticIntegrals) {
  constexpr double theta_0 = 2;
  const double quarter = quarter_period(theta_0);
  for (const Method method : all_methods) {
    const auto run = integrated(pendulum(), {.y_start = {theta_0, 0},
                                             .t_end = 4.5 * quarter,
                                             .events = {{.value = [](double, auto y) { return y[0]; }},
                                                        {.value = [](double, auto y) { return y[1]; }}},
                                             .method = method,
                                             .tolerances = tight});
    ASSERT_EQ(run.events.size(), 4u) << name(method);  // at rest at the start: no event
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(run.events[i].event, i % 2);
      EXPECT_NEAR(run.events[i].t, double(i + 1) * quarter, promised) << name(method);
    }
  }
}

TEST(IntegrateEvents, BriefDipIsSeenWithinAStep) {
  // x = cos t lies below -0.9 for 0.9 around pi; at loose tolerances a step of erk is about 1.5 long.
  for (const Method method : all_methods) {
    const auto run =
        integrated(oscillator(), {.y_start = {1, 0},
                                  .t_end = 6,
                                  .events = {{.value = [](double, auto y) { return y[0] + 0.9; }}},
                                  .method = method,
                                  .tolerances = {1e-4, 1e-4}});
    ASSERT_EQ(run.events.size(), 2u) << name(method);
    EXPECT_NEAR(run.events[0].t, std::acos(-0.9), 0.02);
    EXPECT_NEAR(run.events[1].t, 2 * pi - std::acos(-0.9), 0.02);
  }
}

TEST(IntegrateEvents, TerminalEventEndsTheRunExactlyThere) {
  const auto grid = equal_grid(0, 3, 30);
  for (const Method method : all_methods) {
    RunRequest request{.y_start = {1, 0}, .t_end = 3, .grid = grid, .method = method, .tolerances = tight};
    const auto whole = integrated(oscillator(), request);
    request.events = {{.value = [](double, auto y) { return y[0]; }, .terminal = true}};
    const auto run = integrated(oscillator(), request);
    EXPECT_EQ(run.ending, Ending::event) << name(method);
    EXPECT_NEAR(run.t, pi / 2, promised);
    EXPECT_EQ(run.t, run.events.back().t);
    EXPECT_EQ(run.y, run.events.back().y);
    ASSERT_EQ(run.rows, 16u) << name(method);  // 0, 0.1, ..., 1.5
    for (std::size_t i = 0; i < run.states.size(); ++i) EXPECT_EQ(run.states[i], whole.states[i]);
  }
}

TEST(IntegrateEvents, ConditionDecidesWhetherAZeroCounts) {
  for (const Method method : all_methods) {
    const auto run = integrated(
        oscillator(), {.y_start = {1, 0},
                       .t_end = 20,
                       .events = {{.value = [](double, auto y) { return y[0]; },
                                   .terminal = true,
                                   .condition = [](double t, auto y) { return t > 3 && y[1] < 0; }}},
                       .method = method,
                       .tolerances = tight});
    EXPECT_EQ(run.ending, Ending::event);
    EXPECT_NEAR(run.t, 2.5 * pi, promised) << name(method);
    EXPECT_EQ(run.events.size(), 1u);
  }
}

TEST(IntegrateEvents, BouncingBallRestartsWhereItLanded) {
  // h'' = -1 from h = 1: it lands at sqrt 2, and with its speed turned about every 2 sqrt 2 later.
  const auto system = make_system(
      2,
      [](double, auto y, auto f) {
        assign(f, {y[1], -1});
      },
      [](double, auto, auto j) {
        assign(j, {0, 1, 0, 0});
      });
  for (const Method method : all_methods) {
    RunRequest request{.y_start = {1, 0},
                       .t_end = 100,
                       .events = {{.value = [](double, auto y) { return y[0]; }, .terminal = true}},
                       .method = method,
                       .tolerances = tight};
    for (int bounce = 0; bounce < 10; ++bounce) {
      const auto run = integrated(system, request);
      ASSERT_EQ(run.ending, Ending::event);
      ASSERT_NEAR(run.t, (1 + 2 * bounce) * std::sqrt(2.), promised) << name(method);
      request.t_start = run.t;
      request.y_start = {run.y[0], -run.y[1]};
    }
  }
}

TEST(IntegrateEvents, EventFunctionsMayDependOnTimeAlone) {
  for (const Method method : all_methods) {
    const auto run = integrated(pendulum(), {.y_start = {2, 0},
                                             .t_end = 3,
                                             .events = {{.value = [](double t, auto) { return t - 1.25; }}},
                                             .method = method});
    ASSERT_EQ(run.events.size(), 1u);
    EXPECT_NEAR(run.events[0].t, 1.25, time_round_off(1.25));
  }
}

TEST(IntegrateEvents, LimitReachedWithinAStepLeavesTheStepUndone) {
  // Only erk pays for its dense output. The limit falls into the search for events or among the rows.
  for (const std::size_t rows : {50u, 500u, 5000u})
    for (std::uint64_t most = 400; most < 600; most += 7) {
      const auto grid = equal_grid(0, 50, rows);
      RunRequest request{.y_start = {2, 0},
                         .t_end = 50,
                         .grid = grid,
                         .events = {{.value = [](double, auto y) { return y[0]; }}},
                         .method = Method::erk};
      request.limits.max_evaluations = most;
      const auto run = integrated(pendulum(), request);
      EXPECT_EQ(run.ending, Ending::step_limit);
      EXPECT_EQ(run.evaluations, most);
      ASSERT_GT(run.rows, 0u);
      EXPECT_EQ(run.states.size(), 2 * run.rows);
      EXPECT_LE(grid[run.rows - 1], run.t);
      for (const auto& occurrence : run.events) EXPECT_LE(occurrence.t, run.t);
    }
}

}  // namespace
}  // namespace qdot::integrate_events_test
