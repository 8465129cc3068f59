// Motions that strong damping leaves to bdf, and so their checks, too: errors that both have in common.

#include <gtest/gtest.h>

#include <cmath>

#include "core/motion/ladder.hpp"
#include "tests/support/motions.hpp"
#include "tests/support/system_test.hpp"

namespace qdot {
namespace {

/// x'' = -(b/m) x' - (k/m) x from (x0, 0).
struct Damped {
  double m{}, b{}, k{}, x0{};

  [[nodiscard]] double x(double t) const {
    const double fast = b / m / 2 + std::sqrt(b * b / m / m / 4 - k / m), slow = k / m / fast;
    return x0 * (fast * std::exp(-slow * t) - slow * std::exp(-fast * t)) / (fast - slow);
  }
};

MeasuredSimulation measured(const Damped& system, std::vector<double> grid, double rtol) {
  const auto model = test::model_of("damped_oscillator");
  SimulationRequest request = test::request_for(
      *model, {{"m", system.m}, {"b", system.b}, {"k", system.k}, {"x", system.x0}}, std::move(grid));
  request.method = Method::bdf;
  request.tolerances = {rtol, rtol * 1e-3};
  return simulate_with_error(Dynamics(model), request, {});
}

/// One and the same method with one tolerance makes the same error of truncation twice.
TEST(StrongDamping, IsNotCheckedWithTheToleranceOfTheMotion) {
  const double rtol = 1e-14;
  for (const Damped& system :
       {Damped{1.68, 65800, 1.36, 1.3}, Damped{0.767, 77500, 1.39, 1.1}, Damped{1.37, 19200, 1.14, 0.42},
        Damped{0.312, 21400, 624, 1}, Damped{0.378, 802, 19.2, 0.41}}) {
    const std::vector<double> grid = test::instants(100, 5);
    const MeasuredSimulation m = measured(system, grid, rtol);
    ASSERT_EQ(m.simulation.method, Method::bdf);
    ASSERT_EQ(m.max_abs_error.size(), 2U) << m.reason;
    for (std::size_t i = 0; i < m.simulation.rows; ++i)
      EXPECT_NEAR(test::row(m.simulation, i)[0], system.x(grid[i]), m.max_abs_error[0])
          << system.b << " " << grid[i];
    EXPECT_LT(m.max_abs_error[0], 1e-10 * system.x0);
  }
}

/// Their tolerances shorten no step where all of the motion is smaller.
TEST(StrongDamping, OfASmallMotionIsKnownByToleranceAlone) {
  for (const double x0 : {1e-9, 4e-10, 2e-11}) {
    for (const double b : {900.0, 3e4, 3.48e5}) {
      const Damped system{1, b, 64, x0};
      const std::vector<double> grid = test::instants(7, 5);
      const MeasuredSimulation m = measured(system, grid, 1e-9);
      ASSERT_EQ(m.max_abs_error.size(), 2U) << m.reason;
      for (std::size_t i = 0; i < m.simulation.rows; ++i)
        EXPECT_NEAR(test::row(m.simulation, i)[0], system.x(grid[i]), m.max_abs_error[0])
            << b << " " << grid[i];
      EXPECT_LT(m.max_abs_error[0], 1e-11);
    }
  }
}

/// Each step may round its sums alike in both.
TEST(StrongDamping, CountsTheRoundingOfItsSteps) {
  const Damped system{1, 2000, 3, 1};
  for (const double rtol : {1e-12, 1e-14}) {
    const MeasuredSimulation m = measured(system, test::instants(40, 5), rtol);
    ASSERT_EQ(m.max_abs_error.size(), 2U) << m.reason;
    EXPECT_GE(m.max_abs_error[0], 0x1p-53 * static_cast<double>(m.simulation.steps));
  }
}

}  // namespace
}  // namespace qdot
