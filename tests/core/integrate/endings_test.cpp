// How a run can end, and that it says so with the last good state.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/base/work.hpp"
#include "core/integrate/integrate.hpp"
#include "tests/core/integrate/systems.hpp"

namespace qdot {
namespace {

using namespace integrate_test;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// y' = 1 (so y = t from y(0) = 0), with `outside` for an answer where `ends` says so.
template <class Ends>
RightHandSide clock_until(Evaluation outside, Ends ends) {
  return {1,
          [=](double t, std::span<const double> y, std::span<double> f) {
            f[0] = 1;
            return ends(t, y[0]) ? outside : Evaluation::ok;
          },
          [](double, std::span<const double>, std::span<double> j) {
            j[0] = 0;
            return Evaluation::ok;
          }};
}

/// y' = y^2: from y(0) = 1 the pole of 1/(1 - t).
RightHandSide square() {
  return make_system(
      1, [](double, auto y, auto f) { f[0] = y[0] * y[0]; }, [](double, auto y, auto j) { j[0] = 2 * y[0]; });
}

/// r'' = -1/r^2: from rest at r = 1 the collision at t = pi / 2 sqrt 2.
RightHandSide fall() {
  return make_system(
      2,
      [](double, auto y, auto f) {
        assign(f, {y[1], -1 / (y[0] * y[0])});
      },
      [](double, auto y, auto j) {
        assign(j, {0, 1, 2 / (y[0] * y[0] * y[0]), 0});
      });
}

// At tight tolerances the guard stops the approach where 1000 steps cover less than 1e-9 of the span (here
// 2).
constexpr double within_guard = 2e-9;

void expect_finite(const Run& run) {
  for (const double value : run.y) EXPECT_TRUE(std::isfinite(value));
  for (const double value : run.states) EXPECT_TRUE(std::isfinite(value));
}

TEST(IntegrateEndings, PoleOfASolutionIsABlowUp) {
  const auto grid = equal_grid(0, 2, 100);
  for (const Method method : all_methods)
    for (const double rtol : {1e-3, 1e-6, 1e-9, 1e-12, 1e-14}) {
      const auto run = integrated(
          square(),
          {.y_start = {1}, .t_end = 2, .grid = grid, .method = method, .tolerances = {rtol, 1e-12}});
      EXPECT_EQ(run.ending, Ending::blow_up) << name(method) << ' ' << rtol;
      EXPECT_NEAR(run.t, 1, 100 * rtol + within_guard) << name(method) << ' ' << rtol;
      EXPECT_GT(run.y[0], 1e9) << name(method) << ' ' << rtol;
      EXPECT_LT(run.steps, 20'000u);
      expect_finite(run);
    }
}

TEST(IntegrateEndings, FallIntoACentreDoesNotComeOutOnTheOtherSide) {
  for (const Method method : all_methods)
    for (const double rtol : {1e-3, 1e-6, 1e-9, 1e-12, 1e-14}) {
      const auto run =
          integrated(fall(), {.y_start = {1, 0}, .t_end = 2, .method = method, .tolerances = {rtol, 1e-12}});
      EXPECT_EQ(run.ending, Ending::blow_up) << name(method) << ' ' << rtol;
      EXPECT_NEAR(run.t, std::numbers::pi / (2 * std::sqrt(2.)), 100 * rtol + within_guard)
          << name(method) << ' ' << rtol;
      EXPECT_GT(run.y[0], 0);
    }
}

TEST(IntegrateEndings, GrowthBeyondTheLargestMagnitudeIsABlowUp) {
  const auto system = make_system(
      1, [](double, auto y, auto f) { f[0] = y[0]; }, [](double, auto, auto j) { j[0] = 1; });
  for (const Method method : all_methods) {
    RunRequest request{.y_start = {1}, .t_end = 1000, .method = method, .tolerances = {1e-6, 1e-9}};
    request.limits.max_magnitude = 1e50;
    const auto run = integrated(system, request);
    EXPECT_EQ(run.ending, Ending::blow_up) << name(method);
    EXPECT_NEAR(run.t, 50 * std::log(10.), 0.1) << name(method);
    EXPECT_LE(run.y[0], 1e50);
  }
}

TEST(IntegrateEndings, WhereTheForceHasNoValueTheRunIsNonfinite) {
  const auto grid = equal_grid(0, 2, 200);
  for (const Method method : all_methods)
    for (const double outside : {1., nan, infinity, -infinity}) {
      RightHandSide system = clock_until(Evaluation::nonfinite, [](double t, double) { return t > 1; });
      if (outside != 1)  // it does not say so itself
        system.derivative = [outside](double t, auto, auto f) {
          f[0] = t > 1 ? outside : 1;
          return Evaluation::ok;
        };
      const auto run = integrated(system, {.y_start = {0}, .t_end = 2, .grid = grid, .method = method});
      EXPECT_EQ(run.ending, Ending::nonfinite) << name(method);
      EXPECT_NEAR(run.t, 1, 1e-12) << name(method);
      EXPECT_NEAR(run.y[0], 1, 1e-9) << name(method);
      EXPECT_GE(run.rows, 100u);
      EXPECT_LE(run.rows, 101u);
      expect_finite(run);
    }
}

TEST(IntegrateEndings, NoValueAtTheStartEndsAtTheStart) {
  for (const Method method : all_methods) {
    const RightHandSide system = clock_until(Evaluation::nonfinite, [](double, double) { return true; });
    const auto run = integrated(system, {.y_start = {0}, .t_end = 1, .method = method});
    EXPECT_EQ(run.ending, Ending::nonfinite);
    EXPECT_EQ(run.t, 0);
  }
}

TEST(IntegrateEndings, StateThatIsNoNumberIsNotIntegrated) {
  const RightHandSide system = clock_until(Evaluation::ok, [](double, double) { return false; });
  for (const Method method : all_methods) {
    EXPECT_EQ(integrated(system, {.y_start = {nan}, .t_end = 1, .method = method}).ending, Ending::nonfinite);
    EXPECT_EQ(integrated(system, {.y_start = {infinity}, .t_end = 1, .method = method}).ending,
              Ending::blow_up);
  }
}

TEST(IntegrateEndings, AnExcursionOfATrialPointIsRetriedWithAShorterStep) {
  // y' = sqrt(1 - y^2), y = sin t: a trial point beyond 1 has no derivative, though the motion stays below.
  constexpr double t_end = 1.5707;
  for (const Method method : all_methods) {
    int excursions = 0;
    double latest = 0;
    RightHandSide system;
    system.dimension = 1;
    system.derivative = [&excursions, &latest](double t, auto y, auto f) {
      latest = std::max(latest, t);
      f[0] = std::sqrt(1 - y[0] * y[0]);
      excursions += std::isnan(f[0]);
      return Evaluation::ok;
    };
    system.jacobian = [](double, auto y, auto j) {
      j[0] = -y[0] / std::sqrt(1 - y[0] * y[0]);
      return Evaluation::ok;
    };
    const auto run =
        integrated(system, {.y_start = {0}, .t_end = t_end, .method = method, .tolerances = {1e-5, 1e-5}});
    EXPECT_EQ(run.ending, Ending::reached_end) << name(method);
    EXPECT_GT(excursions, 0) << name(method);
    EXPECT_LE(latest, t_end) << name(method);
    EXPECT_NEAR(run.y[0], std::sin(t_end), 1e-3) << name(method);
  }
}

TEST(IntegrateEndings, LostMassMatrixIsNamed) {
  for (const Method method : all_methods) {
    const RightHandSide system =
        clock_until(Evaluation::singular_mass, [](double, double y) { return y > 1; });
    const auto run = integrated(system, {.y_start = {0}, .t_end = 2, .method = method});
    EXPECT_EQ(run.ending, Ending::singular_mass) << name(method);
    EXPECT_NEAR(run.t, 1, 1e-9) << name(method);
  }
}

TEST(IntegrateEndings, SingularJacobianIsNamedToo) {
  RightHandSide system = pendulum();
  system.jacobian = [jacobian = system.jacobian](double t, auto y, auto j) {
    return t > 1 ? Evaluation::singular_mass : jacobian(t, y, j);
  };
  const auto run = integrated(system, {.y_start = {2, 0}, .t_end = 100, .method = Method::bdf});
  EXPECT_EQ(run.ending, Ending::singular_mass);
  EXPECT_GT(run.t, 0);
}

TEST(IntegrateEndings, TolerancesBeyondDoublePrecisionAreRefused) {
  for (const Method method : all_methods) {
    const auto run = integrated(
        oscillator(), {.y_start = {1, 0}, .t_end = 10, .method = method, .tolerances = {1e-16, 1e-30}});
    EXPECT_EQ(run.ending, Ending::tolerance) << name(method);
  }
}

TEST(IntegrateEndings, StepsAndEvaluationsAreBounded) {
  const auto grid = equal_grid(0, 100, 1000);
  for (const Method method : all_methods) {
    RunRequest request{.y_start = {2, 0}, .t_end = 100, .grid = grid, .method = method};
    request.limits.max_steps = 50;
    const auto few_steps = integrated(pendulum(), request);
    EXPECT_EQ(few_steps.ending, Ending::step_limit) << name(method);
    EXPECT_EQ(few_steps.steps, 50u);
    EXPECT_GT(few_steps.t, 0);

    request.limits = {.max_evaluations = 333};
    const auto few_evaluations = integrated(pendulum(), request);
    EXPECT_EQ(few_evaluations.ending, Ending::step_limit) << name(method);
    EXPECT_EQ(few_evaluations.evaluations, 333u);
    ASSERT_GT(few_evaluations.rows, 0u);
    EXPECT_LE(grid[few_evaluations.rows - 1], few_evaluations.t);
    EXPECT_GT(grid[few_evaluations.rows], few_evaluations.t);
  }
}

TEST(IntegrateEndings, SlidingDiscontinuityIsStoppedAfterAThousandIdleSteps) {
  const auto system = make_system(
      1, [](double, auto y, auto f) { f[0] = y[0] > 0 ? -1 : 1; }, [](double, auto, auto j) { j[0] = 0; });
  for (const Method method : all_methods) {
    const auto run =
        integrated(system, {.y_start = {0.5}, .t_end = 100, .method = method, .tolerances = {1e-14, 1e-14}});
    EXPECT_EQ(run.ending, Ending::step_limit) << name(method);
    EXPECT_NEAR(run.t, 0.5, 1e-9);
    EXPECT_LT(run.steps, 5000u) << name(method);
  }
}

TEST(IntegrateEndings, JumpInTheForceIsNoObstacle) {
  const auto system = make_system(
      1, [](double t, auto y, auto f) { f[0] = t > 50 ? -y[0] : 1; },
      [](double t, auto, auto j) { j[0] = t > 50 ? -1 : 0; });
  for (const Method method : all_methods) {
    const auto run =
        integrated(system, {.y_start = {1}, .t_end = 60, .method = method, .tolerances = {1e-13, 1e-13}});
    EXPECT_EQ(run.ending, Ending::reached_end) << name(method);
    EXPECT_NEAR(run.y[0], 51 * std::exp(-10.), 1e-10) << name(method);
  }
}

TEST(IntegrateEndings, InterruptionIsSeenWithin64Evaluations) {
  for (const Method method : all_methods) {
    int polls = 0;
    int evaluations = 0;
    const WorkScope scope(0, [&polls] { return ++polls == 3; });
    auto system = pendulum();
    system.derivative = [&evaluations, f = system.derivative](double t, auto y, auto out) {
      ++evaluations;
      return f(t, y, out);
    };
    const RunRequest request{.y_start = {2, 0}, .t_end = 1e6, .method = method};
    EXPECT_THROW((void)integrated(system, request), Interrupted) << name(method);
    EXPECT_LT(evaluations, 3 * 64) << name(method);
  }
}

TEST(IntegrateEndings, ExtremeSpansHaveNames) {
  struct Case {
    double t_start, t_end;
  };
  for (const Method method : all_methods)
    for (const auto [t_start, t_end] :
         {Case{0, 1e300}, Case{0, 1e20}, Case{0, 1e-50}, Case{0, 1e-139}, Case{0, 1e-160}, Case{0, 1e-300},
          Case{0, 5e-324}, Case{1e300, 1.1e300}, Case{-8e307, 8e307}, Case{1, std::nextafter(1, 2)},
          Case{1e6, 1e6 + 1}}) {
      const auto grid = equal_grid(t_start, t_end, 3);
      RunRequest request{
          .t_start = t_start, .y_start = {2, 0}, .t_end = t_end, .grid = grid, .method = method};
      request.events = {{.value = [](double, auto y) { return y[0]; }}};
      request.limits = {.max_steps = 10'000, .max_evaluations = 100'000};
      const auto run = integrated(pendulum(), request);
      EXPECT_LE(run.t, t_end);
      EXPECT_GE(run.t, t_start);
      EXPECT_EQ(run.ending == Ending::reached_end, run.t == t_end) << name(method) << ' ' << t_end;
      expect_finite(run);
      if (t_end - t_start < 1e-140) {
        EXPECT_EQ(run.ending, Ending::tolerance);
      } else if (t_end - t_start < 10) {
        EXPECT_EQ(run.ending, Ending::reached_end) << name(method) << ' ' << t_end;
      }
    }
}

TEST(IntegrateEndings, NothingIsWrittenToStandardError) {
  testing::internal::CaptureStderr();
  for (const Method method : all_methods) {
    (void)integrated(square(), {.y_start = {1}, .t_end = 2, .method = method});
    (void)integrated(oscillator(),
                     {.y_start = {1, 0}, .t_end = 1, .method = method, .tolerances = {1e-16, 1e-30}});
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace qdot
