// Motions to thirty digits: closed forms, and motions computed with 45 digits elsewhere.

#include "core/integrate/extended_run.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numerics/double_double_function.hpp"

namespace qdot::extended_run_test {
namespace {

/// c[k] for y'' = -rate^2 y: c_k+2 = a_k/((k+1)(k+2)) with a given by a recurrence.
ExtendedSystem oscillator(double rate = 1) {
  ExtendedSystem system;
  system.dimension = 2;
  system.expansion = [square = rate * rate](const DoubleDouble&, std::span<const DoubleDouble> y,
                                            unsigned order, std::span<DoubleDouble> c) {
    c[0] = y[0];
    c[order + 1] = y[1];
    for (unsigned k = 1; k <= order; ++k) {
      c[k] = c[order + k] / DoubleDouble(k);
      c[order + 1 + k] = -square * c[k - 1] / DoubleDouble(k);
    }
    return Evaluation::ok;
  };
  return system;
}

/// y' = y^2
ExtendedSystem explosion() {
  ExtendedSystem system;
  system.dimension = 1;
  system.expansion = [](const DoubleDouble&, std::span<const DoubleDouble> y, unsigned order,
                        std::span<DoubleDouble> c) {
    c[0] = y[0];
    for (unsigned k = 1; k <= order; ++k) c[k] = c[k - 1] * y[0];
    return Evaluation::ok;
  };
  return system;
}

/// y' = 1 for t < 1 and 2 from there on: no series shows the kink.
ExtendedSystem kinked() {
  ExtendedSystem system;
  system.dimension = 1;
  system.expansion = [](const DoubleDouble& t, std::span<const DoubleDouble> y, unsigned order,
                        std::span<DoubleDouble> c) {
    std::ranges::fill(c, DoubleDouble());
    c[0] = y[0];
    c[1] = t.high < 1 ? 1 : 2;
    (void)order;
    return Evaluation::ok;
  };
  return system;
}

ExtendedRunRequest request(std::vector<DoubleDouble> y, DoubleDouble t_end, double rtol = 1e-32) {
  ExtendedRunRequest result;
  result.y_start = std::move(y);
  result.t_end = t_end;
  result.order = extended_order(rtol, 40);
  result.tolerances = {rtol, rtol * 1e-3};
  return result;
}

TEST(ExtendedRun, FollowsSineAndCosineToThirtyDigits) {
  const DoubleDouble tenth = DoubleDouble(1) / DoubleDouble(10);
  std::vector<DoubleDouble> grid;
  for (int i = 0; i <= 1000; ++i) grid.push_back(DoubleDouble(i) * tenth);
  const ExtendedSystem system = oscillator();
  const ExtendedRun run = integrate(system, request({1.0, 0.0}, grid.back()), grid);
  ASSERT_EQ(run.ending, Ending::reached_end);
  ASSERT_EQ(run.rows, grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const SineCosine exact = sine_cosine(grid[i]);
    EXPECT_LE(std::abs((run.states[2 * i] - exact.cosine).high), 1e-29) << i;
    EXPECT_LE(std::abs((run.states[2 * i + 1] + exact.sine).high), 1e-29) << i;
  }
}

TEST(ExtendedRun, ErrsLessWithATighterTolerance) {
  const ExtendedSystem system = oscillator();
  double before = 1;
  for (const double rtol : {1e-12, 1e-18, 1e-24}) {
    const std::vector<DoubleDouble> grid{30.0};
    const ExtendedRun run = integrate(system, request({1.0, 0.0}, 30.0, rtol), grid);
    const double error = std::abs((run.states[0] - sine_cosine(30.0).cosine).high);
    EXPECT_LE(error, 1e4 * rtol);
    EXPECT_LE(error, before * 1e-3);
    before = error;
  }
}

TEST(ExtendedRun, FollowsAMotionSoFastThatCoefficientsOverflow) {
  constexpr double rate = 0x1p40;
  const DoubleDouble t_end = 30 / rate;
  const ExtendedSystem system = oscillator(rate);
  const std::vector<DoubleDouble> grid{t_end};
  const ExtendedRun run = integrate(system, request({1.0, 0.0}, t_end), grid);
  ASSERT_EQ(run.rows, 1u);
  EXPECT_LE(std::abs((run.states[0] - sine_cosine(30.0).cosine).high), 1e-29);
  EXPECT_LE(run.steps, 250u);
}

TEST(ExtendedRun, TakesFewerOrdersWhereABoundHoldsItsSteps) {
  ExtendedSystem system = oscillator();
  ExtendedRunRequest asked = request({1.0, 0.0}, 3.0);
  asked.lower_order = asked.order / 2;
  const ExtendedRun free = integrate(system, asked, {});
  EXPECT_EQ(free.evaluations, asked.order * (free.steps + 1));
  system.hidden = [](double, std::span<const double>, double h, std::span<const double>, std::span<double>) {
    return h / 0.01;
  };
  const ExtendedRun held = integrate(system, asked, {});
  EXPECT_TRUE(held.bounded);
  EXPECT_EQ(held.evaluations, asked.order + asked.lower_order * held.steps);
  EXPECT_LE(std::abs((held.y[0] - sine_cosine(3.0).cosine).high), 1e-29);
}

TEST(ExtendedRun, SaysWhereTheMotionEnds) {
  const ExtendedSystem system = explosion();
  const std::vector<DoubleDouble> grid{0.5, 0.75, 2.0};
  const ExtendedRun run = integrate(system, request({1.0}, 2.0), grid);
  EXPECT_EQ(run.ending, Ending::blow_up);
  ASSERT_EQ(run.rows, 2u);
  EXPECT_LE(std::abs((run.states[0] - DoubleDouble(2)).high), 1e-29);
  EXPECT_LE(std::abs((run.states[1] - DoubleDouble(4)).high), 1e-28);
  EXPECT_LT(run.t.high, 1 + 1e-12);
}

TEST(ExtendedRun, StopsAtAKinkThatNoCoefficientShows) {
  const ExtendedSystem system = kinked();
  const std::vector<DoubleDouble> grid{0.5, 2.0};
  const ExtendedRun run = integrate(system, request({0.0}, 2.0), grid);
  EXPECT_NE(run.ending, Ending::reached_end);
  EXPECT_NEAR(run.t.high, 1, 1e-12);
}

/// sin(1/2) of a motion that is followed while it is below that.
TEST(ExtendedRun, EndsWhereItsMarginIsUsedUp) {
  const SineCosine exact = sine_cosine(0.5);
  for (const double from : {0.0, 1e-31}) {  // rounding before the place where a piece begins
    ExtendedSystem system = oscillator();
    system.margin = [&](const DoubleDouble& t, std::span<const DoubleDouble> y) {
      return t.high == 0 && from > 0 ? -from : (exact.sine - y[0]).value();
    };
    const std::vector<DoubleDouble> grid{0.1, 0.4, 0.6, 3.0};
    const ExtendedRun run = integrate(system, request({0.0, 1.0}, 3.0), grid);
    ASSERT_EQ(run.ending, Ending::event);
    EXPECT_EQ(run.rows, 2U);
    EXPECT_LE(std::abs((run.t - DoubleDouble(0.5)).value()), 1e-30);
    EXPECT_LE(std::abs((run.y[1] - exact.cosine).value()), 1e-30);
  }
}

TEST(ExtendedRun, IsUndeterminedWhereItNeverHadAMargin) {
  ExtendedSystem system = oscillator();
  system.margin = [](const DoubleDouble&, std::span<const DoubleDouble>) { return -1.0; };
  const std::vector<DoubleDouble> grid{0.1, 3.0};
  const ExtendedRun run = integrate(system, request({0.0, 1.0}, 3.0), grid);
  EXPECT_EQ(run.ending, Ending::undetermined);
  EXPECT_EQ(run.rows, 0U);
}

/// y'' = -y with an error of 1e-20 at the start, which the motion carries on.
TEST(ExtendedRun, GoesOnWithWhatItsStartIsOffBy) {
  ExtendedSystem system = oscillator();
  system.in_doubles.expansion = [](double, std::span<const double> y, unsigned order, std::span<double> c) {
    c[0] = y[0];
    c[order + 1] = y[1];
    for (unsigned k = 1; k <= order; ++k) {
      c[k] = c[order + k] / k;
      c[order + 1 + k] = -c[k - 1] / k;
    }
    return Evaluation::ok;
  };
  ExtendedRunRequest asked = request({0.0, 1.0}, 0.5);
  asked.apart = {1e-20, 0};
  const std::vector<DoubleDouble> grid{0.5};
  const ExtendedRun run = integrate(system, asked, grid);
  ASSERT_EQ(run.apart_at_end.size(), 2U);
  EXPECT_NEAR(run.apart_at_end[0], 1e-20 * std::cos(0.5), 1e-23);
  EXPECT_NEAR(run.apart_at_end[1], -1e-20 * std::sin(0.5), 1e-23);
}

TEST(ExtendedRun, SpendsNoMoreThanItMay) {
  const ExtendedSystem system = oscillator();
  ExtendedRunRequest limited = request({1.0, 0.0}, 1e6);
  limited.limits.max_evaluations = 1000;
  const ExtendedRun run = integrate(system, limited, {});
  EXPECT_EQ(run.ending, Ending::step_limit);
  EXPECT_LE(run.evaluations, 1000u);
  EXPECT_GT(run.t.high, 0);
}

TEST(ExtendedOrder, GrowsWithTheDigits) {
  EXPECT_EQ(extended_order(1e-30, 40), 35u);
  EXPECT_EQ(extended_order(1e-20, 40), 24u);
  EXPECT_EQ(extended_order(1e-20, 22), 22u);
}

}  // namespace
}  // namespace qdot::extended_run_test
