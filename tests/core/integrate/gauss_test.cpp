// Gauss's method beyond what every method of a fixed step promises (fixed_steps_test.cpp): its symmetry, its
// invariants, its two iterations, and how it ends.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/integrate/integrate.hpp"
#include "core/integrate/methods.hpp"
#include "tests/core/integrate/systems.hpp"

namespace qdot {
namespace {

using namespace integrate_test;

RunRequest request_with(double h, std::vector<double> y_start, double t_end) {
  return {.y_start = std::move(y_start), .t_end = t_end, .method = Method::gauss, .h = h};
}

TEST(Gauss, GoesBackTheWayItCame) {
  // The method is its own inverse with the velocity turned round; the errors of both ways cancel to
  // round-off, at a step that is wrong by far more.
  const double h = 0.5, t_end = 200;
  const auto there = integrated(pendulum(), request_with(h, {2, 0.3}, t_end));
  const auto back = integrated(pendulum(), request_with(h, {there.y[0], -there.y[1]}, t_end));
  EXPECT_NEAR(back.y[0], 2, 1e-12);
  EXPECT_NEAR(back.y[1], -0.3, 1e-12);
  const auto finer = integrated(pendulum(), request_with(h / 10, {2, 0.3}, t_end));
  EXPECT_GT(std::abs(finer.y[0] - there.y[0]), 1e-6);
}

TEST(Gauss, KeepsQuadraticInvariantsToRoundOff) {
  // As every symplectic Runge-Kutta method does: x^2 + v^2 of the oscillator, at two steps a period.
  RunRequest request = request_with(3, {1, 0}, 3e5);
  const auto run = integrated(oscillator(), request);
  ASSERT_EQ(run.ending, Ending::reached_end);
  EXPECT_EQ(run.steps, 100'000u);
  EXPECT_NEAR(run.y[0] * run.y[0] + run.y[1] * run.y[1], 1, 1e-12);
}

/// x'' = -w^2 x, stiff for a step of many periods.
RightHandSide fast_oscillator(double w) {
  return make_system(
      2,
      [w](double, auto y, auto f) {
        assign(f, {y[1], -w * w * y[0]});
      },
      [w](double, auto, auto j) {
        assign(j, {0, 1, -w * w, 0});
      });
}

TEST(Gauss, NewtonTakesOverWhereTheFixedPointIterationDiverges) {
  const auto run = integrated(fast_oscillator(1e4), request_with(0.01, {1, 0}, 10));
  ASSERT_EQ(run.ending, Ending::reached_end);
  EXPECT_NEAR(run.y[0] * run.y[0] + run.y[1] * run.y[1] * 1e-8, 1, 1e-10);  // no damping, no growth
  RightHandSide without = fast_oscillator(1e4);
  without.jacobian = {};
  EXPECT_EQ(integrated(without, request_with(0.01, {1, 0}, 10)).ending, Ending::no_convergence);
}

TEST(Gauss, StepThatHasNoSolutionIsNamed) {
  // x' = x^2 + 1: x = tan t, and no step leads across the pole.
  const RightHandSide system = make_system(
      1, [](double, auto y, auto f) { f[0] = y[0] * y[0] + 1; },
      [](double, auto y, auto j) { j[0] = 2 * y[0]; });
  for (const double h : {0.1, 0.3, 0.5, 1.5, 3.}) {
    const auto run = integrated(system, request_with(h, {0}, 3));
    EXPECT_EQ(run.ending, Ending::no_convergence) << h;
    EXPECT_LT(run.t, std::acos(0)) << h;
    EXPECT_NEAR(run.y[0], std::tan(run.t), 0.01 * run.y[0]) << h;
  }
}

TEST(Gauss, RestsInAnEquilibriumThatOnlyRoundOffDisturbs) {
  // The force at theta = 0.1 is a difference that rounds to some 1e-17 or to 0.
  const double s = std::sin(0.1);
  const RightHandSide system = make_system(
      2,
      [s](double, auto y, auto f) {
        assign(f, {y[1], 1e3 * (s - std::sin(y[0]))});
      },
      [](double, auto y, auto j) {
        assign(j, {0, 1, -1e3 * std::cos(y[0]), 0});
      });
  for (const double theta : {0.1, std::nextafter(0.1, 1), 0.1 + 3e-16, 0.1 - 1e-15}) {
    const auto run = integrated(system, request_with(0.01, {theta, 0}, 100));
    EXPECT_EQ(run.ending, Ending::reached_end) << theta;
    EXPECT_NEAR(run.y[0], 0.1, 1e-14);
  }
}

}  // namespace
}  // namespace qdot
