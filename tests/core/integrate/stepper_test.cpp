#include "core/integrate/methods.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "core/integrate/initial_step.hpp"
#include "core/integrate/series_at_four.hpp"
#include "core/integrate/series_sums.hpp"
#include "tests/core/integrate/systems.hpp"
#include "tests/support/random.hpp"

namespace qdot {
namespace {

using namespace integrate_test;

TEST(Stepper, DenseOutputMeetsTheStepsAtBothEndsToTheBit) {
  const RightHandSide system = pendulum();
  for (const Method method : all_methods) {
    const RunRequest request{.y_start = {2, 0}, .t_end = 10, .method = method, .tolerances = {1e-7, 1e-7}};
    const auto stepper = make_stepper(system, request);
    std::vector<double> before = request.y_start;
    std::vector<double> y(2);
    while (stepper->t() < request.t_end) {
      const double t_before = stepper->t();
      ASSERT_FALSE(stepper->step());
      ASSERT_EQ(stepper->t_previous(), t_before);
      ASSERT_FALSE(stepper->interpolate(t_before, y));
      EXPECT_EQ(y, before) << name(method) << ' ' << t_before;
      ASSERT_FALSE(stepper->interpolate(stepper->t(), y));
      EXPECT_TRUE(std::ranges::equal(y, stepper->y())) << name(method);
      before.assign(stepper->y().begin(), stepper->y().end());
    }
    EXPECT_EQ(stepper->t(), 10);
  }
}

/// x'' = -x with its Taylor coefficients.
RightHandSide expanded_oscillator() {
  RightHandSide system = oscillator();
  system.expansion = [](double, std::span<const double> y, unsigned order, std::span<double> c) {
    double *x = c.data(), *v = x + order + 1;
    x[0] = y[0];
    v[0] = y[1];
    for (unsigned k = 1; k <= order; ++k) {
      x[k] = v[k - 1] / k;
      v[k] = -x[k - 1] / k;
    }
    return Evaluation::ok;
  };
  return system;
}

/// `count` times from the beginning of the last step on, the last of several at its end.
std::vector<double> times_in(const Stepper& stepper, std::size_t count) {
  std::vector<double> times;
  for (std::size_t i = 0; i < count; ++i) {
    times.push_back(std::lerp(stepper.t_previous(), stepper.t(), static_cast<double>(i) / 10));
  }
  if (count > 1) times.back() = stepper.t();
  return times;
}

TEST(Stepper, SamplesAreWhatDenseOutputGivesToTheBit) {
  const RightHandSide system = expanded_oscillator();
  for (const Method method : {Method::adams, Method::erk, Method::taylor}) {
    for (const unsigned order : {15U, 16U}) {
      RunRequest request{.y_start = {2, 0}, .t_end = 8, .method = method, .tolerances = {1e-7, 1e-7}};
      request.taylor_order = order;
      const auto stepper = make_stepper(system, request);
      while (stepper->t() < request.t_end) {
        ASSERT_FALSE(stepper->step());
        for (std::size_t count = 0; count <= 9; ++count) {
          const std::vector<double> times = times_in(*stepper, count);
          std::vector<double> rows(2 * count), row(2);
          ASSERT_FALSE(stepper->sample(times, rows));
          for (std::size_t i = 0; i < count; ++i) {
            ASSERT_FALSE(stepper->interpolate(times[i], row));
            EXPECT_TRUE(std::ranges::equal(row, std::span(rows).subspan(2 * i, 2))) << name(method) << i;
          }
        }
      }
    }
  }
}

TEST(Stepper, SumsOfFourSeriesHaveTheSameBitsOnEveryProcessor) {
  test::Random random(5);
  for (std::size_t order = 1; order <= 24; ++order) {
    std::vector<double> c(3 * (order + 1)), s(4), fastest(12), plain(12), alone(3);
    for (double& x : c) x = random.real(-1, 1);
    for (double& x : s) x = random.real(-2, 2);
    sum_series_at_four(c.data(), order, s.data(), fastest);
    sum_series_at_four_plainly(c.data(), order, s.data(), plain);
    EXPECT_EQ(fastest, plain) << order;
    for (std::size_t j = 0; j < 4; ++j) {
      sum_all_series<SeriesSum::value>(c.data(), order, s[j], alone);
      for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(alone[i], plain[4 * i + j]) << order;
    }
  }
}

TEST(Stepper, DenseOutputWithinAStepIsAsGoodAsItsEnds) {
  // Largest errors over the run, at the ends of steps and between; "as good" is within a factor of three.
  const RightHandSide system = pendulum();
  const auto error = [](std::span<const double> y, double t) {
    return std::abs(y[0] - released_pendulum(t, 2)[0]);
  };
  for (const Method method : all_methods)
    for (const double tolerance : {1e-5, 1e-8, 1e-11}) {
      const RunRequest request{
          .y_start = {2, 0}, .t_end = 10, .method = method, .tolerances = {tolerance, tolerance}};
      const auto stepper = make_stepper(system, request);
      double at_ends = 0;
      double between = 0;
      std::vector<double> y(2);
      while (stepper->t() < request.t_end) {
        ASSERT_FALSE(stepper->step());
        at_ends = std::max(at_ends, error(stepper->y(), stepper->t()));
        for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
          const double t = std::lerp(stepper->t_previous(), stepper->t(), share);
          ASSERT_FALSE(stepper->interpolate(t, y));
          between = std::max(between, error(y, t));
        }
      }
      EXPECT_LT(between, 3 * at_ends) << name(method) << ' ' << tolerance;
    }
}

TEST(Stepper, SketchIsRoughlyTheDenseOutput) {
  const RightHandSide system = pendulum();
  for (const Method method : all_methods) {
    const RunRequest request{.y_start = {2, 0}, .t_end = 10, .method = method};
    const auto stepper = make_stepper(system, request);
    std::vector<double> exact(2);
    std::vector<double> rough(2);
    while (stepper->t() < request.t_end) {
      ASSERT_FALSE(stepper->step());
      if (stepper->steps() % 3 == 1)
        continue;  // sketching a step needs nothing from a sketch of the one before
      const double t = std::lerp(stepper->t_previous(), stepper->t(), 0.4);
      ASSERT_FALSE(stepper->interpolate(t, exact));
      ASSERT_FALSE(stepper->sketch(t, rough));
      EXPECT_NEAR(rough[0], exact[0], 1e-3) << name(method);  // h^4 / 384 of a step of half a second
    }
  }
}

constexpr Tolerances tolerances{1e-6, 1e-6};

TEST(InitialStep, BalancesTheSecondDerivativeAgainstTheTolerances) {
  // x'' = -x from (1, 0): |y'| = |y''| = 1 and the largest weight 1 / (atol + rtol |0|), so h^9 = 0.01 / 1e6.
  const RightHandSide system = oscillator();
  const Limits limits;
  Evaluator evaluator(system, limits);
  const auto h = initial_step(evaluator, 0, std::vector<double>{1, 0}, 100, tolerances, 8);
  ASSERT_TRUE(h);
  EXPECT_NEAR(*h, std::pow(1e-8, 1. / 9), 1e-3);
  EXPECT_EQ(evaluator.evaluations(), 2u);
}

TEST(InitialStep, IsNeverLongerThanTheSpanNorShorterThanTimeResolves) {
  const RightHandSide system = oscillator();
  const Limits limits;
  Evaluator evaluator(system, limits);
  const std::vector<double> y{1, 0};
  EXPECT_EQ(initial_step(evaluator, 0, y, 1e-3, tolerances, 8), 1e-3);
  EXPECT_GT(initial_step(evaluator, 1e12, y, 1e13, tolerances, 1).value(), 1e12 * 2.2e-16);
  EXPECT_EQ(initial_step(evaluator, 0, std::vector<double>{0, 0}, 1e-300, tolerances, 1).value_or(0) > 0,
            true);
}

TEST(InitialStep, TriesNearerWhereFHasNoValue) {
  RightHandSide system = oscillator();
  system.derivative = [f = system.derivative](double t, auto y, auto out) {
    return t > 1e-8 ? Evaluation::nonfinite : f(t, y, out);
  };
  const Limits limits;
  Evaluator evaluator(system, limits);
  EXPECT_TRUE(initial_step(evaluator, 0, std::vector<double>{1, 0}, 100, tolerances, 8));

  system.derivative = [](double, auto, auto) { return Evaluation::singular_mass; };
  EXPECT_FALSE(initial_step(evaluator, 0, std::vector<double>{1, 0}, 100, tolerances, 8));
  EXPECT_EQ(evaluator.trouble(), Ending::singular_mass);
}

}  // namespace
}  // namespace qdot
