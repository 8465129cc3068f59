#include "core/integrate/integrate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tests/core/integrate/systems.hpp"

namespace qdot {
namespace {

using namespace integrate_test;

// What a method's global error may be in multiples of rtol = atol over the few periods integrated here.
// CVODE's tolerances bound the error of a step, and its errors add up to a hundred or a thousand of them
// (measured: 10 to 3000).
constexpr double global_over_local = 1e4;

struct Errors {
  double oscillator;
  double pendulum;
};

Errors errors(Method method, double tolerance) {
  constexpr double theta_0 = 2;
  const auto grid = equal_grid(0, 20, 200);
  RunRequest request{
      .y_start = {1, 0}, .t_end = 20, .grid = grid, .method = method, .tolerances = {tolerance, tolerance}};
  const auto x = integrated(oscillator(), request);
  request.y_start = {theta_0, 0};
  const auto theta = integrated(pendulum(), request);
  EXPECT_EQ(x.rows, grid.size());
  EXPECT_EQ(theta.rows, grid.size());
  return {largest_error(x, grid,
                        [](double t) {
                          return std::array{std::cos(t), -std::sin(t)};
                        }),
          largest_error(theta, grid, [](double t) { return released_pendulum(t, theta_0); })};
}

TEST(Integrate, OscillatorAndPendulumFollowTheirClosedForms) {
  for (const Method method : all_methods)
    for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
      const Errors error = errors(method, tolerance);
      EXPECT_LT(error.oscillator, global_over_local * tolerance) << name(method) << ' ' << tolerance;
      EXPECT_LT(error.pendulum, global_over_local * tolerance) << name(method) << ' ' << tolerance;
    }
}

TEST(Integrate, ToleranceTightenedByAHundredTightensTheError) {
  constexpr double at_least = 4;  // times smaller; the least seen is 7 (adams), a hundred is the ideal
  for (const Method method : all_methods)
    for (double tolerance = 1e-4; tolerance > 2e-12; tolerance /= 100) {
      const Errors coarse = errors(method, tolerance);
      const Errors fine = errors(method, tolerance / 100);
      EXPECT_LT(at_least * fine.oscillator, coarse.oscillator) << name(method) << ' ' << tolerance;
      EXPECT_LT(at_least * fine.pendulum, coarse.pendulum) << name(method) << ' ' << tolerance;
    }
}

TEST(Integrate, MethodsAgreeOnASpringPendulum) {
  const auto grid = equal_grid(0, 10, 100);
  RunRequest request{
      .y_start = {1.2, 0.7, 0.3, -0.2}, .t_end = 10, .grid = grid, .tolerances = {1e-12, 1e-12}};
  request.method = Method::erk;
  const auto by_erk = integrated(spring_pendulum(), request);
  for (const Method method : all_methods) {
    request.method = method;
    const auto run = integrated(spring_pendulum(), request);
    const double bound = method == Method::bdf ? 1e5 : 1e4;  // bdf, of order 5, piles up more
    for (std::size_t i = 0; i < run.states.size(); ++i)
      EXPECT_NEAR(run.states[i], by_erk.states[i], bound * 1e-12) << name(method);
  }
}

TEST(Integrate, TightestTolerancesOfDoublePrecisionStillRun) {
  for (const Method method : all_methods)
    for (const double atol : {1e-12, 1e-14}) {
      const RunRequest request{.y_start = {2, 0}, .t_end = 20, .method = method, .tolerances = {1e-14, atol}};
      const auto run = integrated(pendulum(), request);
      EXPECT_EQ(run.ending, Ending::reached_end) << name(method);
      EXPECT_NEAR(run.y[0], released_pendulum(20, 2)[0], 1e-9) << name(method);
    }
}

TEST(Integrate, RungeKuttaSeesAForceThatDependsOnTimeOnly) {
  // y' = cos t exp(sin t): Fehlberg's 7(8) estimates its error as zero here and takes the span in a few
  // strides.
  const auto system = make_system(
      1, [](double t, auto, auto f) { f[0] = std::cos(t) * std::exp(std::sin(t)); },
      [](double, auto, auto j) { j[0] = 0; });
  const RunRequest request{.y_start = {1}, .t_end = 20, .method = Method::erk, .tolerances = {1e-9, 1e-9}};
  EXPECT_NEAR(integrated(system, request).y[0], std::exp(std::sin(20.)), 1e-8);
}

TEST(Integrate, RowsAreTheSameBitsOnAnyGridAndWithAnyWatchingEvents) {
  const auto coarse = equal_grid(0, 10, 8);
  const auto dense = equal_grid(0, 10, 800);
  for (const Method method : all_methods) {
    RunRequest request{.y_start = {1.2, 0.7, 0.3, -0.2}, .t_end = 10, .grid = coarse, .method = method};
    const auto few = integrated(spring_pendulum(), request);
    request.grid = dense;
    const auto many = integrated(spring_pendulum(), request);
    request.events = {{.value = [](double, auto y) { return y[1]; }},
                      {.value = [](double, auto y) { return y[2]; }}};
    const auto watched = integrated(spring_pendulum(), request);

    ASSERT_EQ(many.rows, dense.size());
    for (std::size_t i = 0; i < coarse.size(); ++i)
      for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(row(few, i, k), row(many, 100 * i, k)) << name(method);
    EXPECT_GT(watched.events.size(), 10u);
    EXPECT_EQ(watched.states, many.states) << name(method);
    EXPECT_EQ(watched.y, few.y) << name(method);
    EXPECT_EQ(watched.steps, few.steps) << name(method);
  }
}

TEST(Integrate, FirstAndLastRowsAreTheEndStates) {
  const std::vector<double> ends{1, 3};
  for (const Method method : all_methods) {
    const RunRequest request{.t_start = 1, .y_start = {2, 0}, .t_end = 3, .grid = ends, .method = method};
    const auto run = integrated(pendulum(), request);
    ASSERT_EQ(run.rows, 2u);
    EXPECT_EQ(run.t, 3);
    EXPECT_EQ(row(run, 0, 0), 2);
    EXPECT_EQ(row(run, 1, 0), run.y[0]);
  }
}

TEST(Integrate, SpanOfNoLengthIsItsOwnEnd) {
  const std::vector<double> here{1};
  const auto run = integrated(
      pendulum(), {.t_start = 1, .y_start = {2, 0}, .t_end = 1, .grid = here, .method = Method::adams});
  EXPECT_EQ(run.ending, Ending::reached_end);
  EXPECT_EQ(run.rows, 1u);
  EXPECT_EQ(run.evaluations, 0u);
}

TEST(Integrate, NothingIsEvaluatedBeyondTheEnd) {
  for (const Method method : all_methods)
    for (const double t_end : {1e-3, 1.0, 7.3, 100.1}) {
      double latest = 0;
      RightHandSide system = pendulum();
      system.derivative = [&latest, f = system.derivative](double t, auto y, auto out) {
        latest = std::max(latest, t);
        return f(t, y, out);
      };
      EXPECT_EQ(integrated(system, {.y_start = {2, 0}, .t_end = t_end, .method = method}).t, t_end);
      EXPECT_LE(latest, t_end) << name(method);
    }
}

TEST(Integrate, CountersTellWhatWasEvaluated) {
  for (const Method method : all_methods) {
    std::uint64_t calls = 0;
    RightHandSide system = pendulum();
    const auto counted = [&calls](auto function) {
      return [&calls, function](double t, auto y, auto out) {
        ++calls;
        return function(t, y, out);
      };
    };
    system.derivative = counted(system.derivative);
    system.jacobian = counted(system.jacobian);
    const auto grid = equal_grid(0, 10, 77);
    const auto run = integrated(system, {.y_start = {2, 0}, .t_end = 10, .grid = grid, .method = method});
    EXPECT_EQ(run.evaluations, calls) << name(method);
  }
}

TEST(Integrate, SameCallGivesTheSameBitsOnEveryThread) {
  const auto grid = equal_grid(0, 5, 50);
  const auto run_all = [&grid] {
    std::vector<qdot::Run> runs;
    for (const Method method : all_methods)
      runs.push_back(
          integrated(spring_pendulum(), {.y_start = {1.2, 0.7, 0.3, -0.2},
                                         .t_end = 5,
                                         .grid = grid,
                                         .events = {{.value = [](double, auto y) { return y[1]; }}},
                                         .method = method}));
    return runs;
  };
  const std::vector<qdot::Run> alone = run_all();
  std::vector<std::vector<qdot::Run>> together(6);
  {
    std::vector<std::jthread> threads;
    for (auto& runs : together) threads.emplace_back([&runs, &run_all] { runs = run_all(); });
  }
  for (const auto& runs : together)
    for (std::size_t m = 0; m < runs.size(); ++m) {
      EXPECT_EQ(runs[m].states, alone[m].states);
      EXPECT_EQ(runs[m].evaluations, alone[m].evaluations);
      ASSERT_EQ(runs[m].events.size(), alone[m].events.size());
      for (std::size_t i = 0; i < runs[m].events.size(); ++i)
        EXPECT_EQ(runs[m].events[i].t, alone[m].events[i].t);
    }
}

TEST(Integrate, BdfFollowsAStiffVanDerPolOscillator) {
  // y'' = 1000 (1 - y^2) y' - y from (2, 0) to t = 2000. Reference: F. Mazzia, C. Magherini, Test Set for
  // Initial Value Problem Solvers, release 2.4, VDPOL, with its t/1000 taken back.
  const auto system = make_system(
      2,
      [](double, auto y, auto f) {
        assign(f, {y[1], 1000 * (1 - y[0] * y[0]) * y[1] - y[0]});
      },
      [](double, auto y, auto j) {
        assign(j, {0, 1, -2000 * y[0] * y[1] - 1, 1000 * (1 - y[0] * y[0])});
      });
  RunRequest request{.y_start = {2, 0}, .t_end = 2000, .method = Method::bdf, .tolerances = {1e-9, 1e-12}};
  const auto run = integrated(system, request);
  EXPECT_EQ(run.ending, Ending::reached_end);
  EXPECT_NEAR(run.y[0], 1.706167732170483, 1e-6);
  EXPECT_NEAR(run.y[1], -0.8928097010247975e-3, 1e-9);
  EXPECT_LT(run.steps, 10'000u);

  request.method = Method::adams;
  request.limits.max_steps = 10'000;
  EXPECT_EQ(integrated(system, request).ending, Ending::step_limit);  // stiff it is
}

TEST(Integrate, BdfFollowsAForcedFastDecay) {
  // y' = -L (y - cos t), y(0) = 0: y = (L^2 cos t + L sin t - L^2 exp(-L t)) / (1 + L^2).
  constexpr double rate = 1e6;
  const auto system = make_system(
      1, [](double t, auto y, auto f) { f[0] = -rate * (y[0] - std::cos(t)); },
      [](double, auto, auto j) { j[0] = -rate; });
  const auto run = integrated(system, {.y_start = {0}, .t_end = 10, .method = Method::bdf});
  EXPECT_NEAR(run.y[0], (rate * rate * std::cos(10.) + rate * std::sin(10.)) / (1 + rate * rate), 1e-8);
  EXPECT_LT(run.steps, 2000u);
}

TEST(Integrate, RefusesTolerancesThatMeanNothing) {
  for (const Tolerances tolerances : {Tolerances{0, 1e-9}, Tolerances{1e-9, 0}, Tolerances{-1e-9, 1e-9},
                                      Tolerances{std::numeric_limits<double>::quiet_NaN(), 1e-9}})
    EXPECT_THROW(
        (void)integrated(pendulum(),
                         {.y_start = {2, 0}, .t_end = 1, .method = Method::erk, .tolerances = tolerances}),
        std::invalid_argument);
}

TEST(Integrate, WhatARightHandSideThrowsReachesTheCaller) {
  for (const Method method : all_methods) {
    RightHandSide system = pendulum();
    system.derivative = [f = system.derivative](double t, auto y, auto out) {
      if (t > 1) throw std::runtime_error("out of memory, say");
      return f(t, y, out);
    };
    EXPECT_THROW((void)integrated(system, {.y_start = {2, 0}, .t_end = 3, .method = method}),
                 std::runtime_error);
  }
}

}  // namespace
}  // namespace qdot
