// Gauss's method on scenes: bounded energy errors, and the same motions as by the other methods.

#include <gtest/gtest.h>

#include <cmath>

#include "core/motion/ladder.hpp"
#include "tests/support/motions.hpp"
#include "tests/support/system_test.hpp"

namespace qdot::gauss_test {
namespace {

/// The largest |E - E0| among the rows from one to another.
double largest_energy_error(const Simulation& motion, std::size_t from, std::size_t to) {
  double largest = 0;
  for (std::size_t i = from; i < to; ++i)
    largest = std::max(largest, std::abs(motion.columns[i] - motion.columns[0]));
  return largest;
}

TEST(GaussOnScenes, EnergyErrorStaysBoundedOverAHundredThousandPeriods) {
  const auto model = test::model_of("whirling_pendulum");
  const Values given{{"m", 1}, {"l", 1}, {"R", 0}, {"Omega", 1}, {"g", 9.81}, {"theta", 1}};
  const double h = 0.5;  // less than five steps a period of 2.27 s
  constexpr int rows = 10'000;
  constexpr int steps = 46 * rows;
  std::vector<double> grid;
  for (int i = 0; i < rows; ++i) grid.push_back(h * (i * 46 + i % 46));  // ends of steps, at all phases
  SimulationRequest request = test::request_for(*model, given, grid);
  request.t_end = h * steps;
  request.method = Method::gauss;
  request.h = h;
  request.limits.max_steps = steps;
  request.limits.max_evaluations = 100ULL * steps;
  for (const Column& column : test::energy_columns(*model))
    if (column.name == "h") request.columns.push_back(column);  // the Jacobi integral: the arm is driven
  const Simulation motion = simulate(Dynamics(model), request);
  ASSERT_EQ(motion.ending, Ending::reached_end);
  EXPECT_TRUE(motion.symplectic);
  const double at_first = largest_energy_error(motion, 0, rows / 10);
  const double at_last = largest_energy_error(motion, rows - rows / 10, rows);
  EXPECT_LT(at_last, 1.01 * at_first);
  EXPECT_GT(at_first, 1e-7);  // the step is coarse enough for a drift to be seen
}

TEST(GaussOnScenes, RoundOffOfTheEnergyIsAWalkAndNoDrift) {
  // At a step that is exact up to rounding: 1e5 steps of 1e-16 each, were they all of one sign, come to
  // 1e-11; at random, to 3e-14.
  const auto model = test::model_of("spring_pendulum");
  SimulationRequest request = test::request_for(
      *model, {{"m", 1}, {"k", 40}, {"l0", 1}, {"l", 1.2}, {"theta", 0.7}}, test::instants(500, 1000));
  request.method = Method::gauss;
  request.h = 0.005;
  request.columns = {test::energy_columns(*model)[2]};
  const Simulation motion = simulate(Dynamics(model), request);
  ASSERT_EQ(motion.ending, Ending::reached_end);
  EXPECT_LT(largest_energy_error(motion, 0, motion.rows), 1e-12);
}

class GaussOfSystem : public test::SystemTest {};
INSTANTIATE_TEST_SUITE_P(Systems, GaussOfSystem, testing::ValuesIn(test::all_systems()), test::system_name);

TEST_P(GaussOfSystem, AgreesWithTheOtherMethods) {
  const Dynamics dynamics(test::model_of(GetParam()));
  const SimulationRequest best = test::request_for(model(), {}, test::instants(2, 20));
  const Simulation by_erk = simulate(dynamics, best);
  SimulationRequest request = best;
  request.method = Method::taylor;
  request.tolerances = {1e-14, 1e-16};
  const Simulation by_taylor = simulate(dynamics, request);
  request.method = Method::gauss;
  request.h = 5e-4;
  const Simulation motion = simulate(dynamics, request);
  ASSERT_EQ(motion.rows, 21u);
  EXPECT_EQ(motion.method, Method::gauss);
  EXPECT_LT(test::difference(motion, by_taylor), 1e-10);
  EXPECT_LT(test::difference(motion, by_erk), 1e-10);
}

TEST_P(GaussOfSystem, HasOrderSix) {
  const Dynamics dynamics(test::model_of(GetParam()));
  SimulationRequest request = test::request_for(model(), {}, test::instants(1, 10));
  const Simulation best = simulate(dynamics, request);
  request.method = Method::gauss;
  const auto error = [&](double h) {
    request.h = h;
    return test::difference(simulate(dynamics, request), best);
  };
  // Halved until the order shows and round-off does not; some are exact at the coarsest step already.
  constexpr double small = 1e-9;
  double h = 0.2, coarse = error(h), fine = coarse;
  while (!(fine < small) && h > 1e-3) {
    coarse = fine;
    fine = error(h /= 2);
  }
  EXPECT_LT(fine, small);
  EXPECT_TRUE(h == 0.2 || fine < coarse / 40) << coarse / fine;  // 64 in the limit
}

TEST(GaussOnScenes, TheMasslessFeetOfTheWalkerHaveNoMomentaOfTheirOwn) {
  const Dynamics dynamics(test::model_of("compass_walker"));
  for (const double m : {0., 1e-9, 0.1}) {
    SimulationRequest request = test::request_for(dynamics.model(), {{"m", m}}, test::instants(3, 30));
    request.on_invalid = OnInvalid::go_on;
    const Simulation best = simulate(dynamics, request);
    request.method = Method::gauss;
    request.h = 1e-3;
    const Simulation motion = simulate(dynamics, request);
    EXPECT_EQ(motion.symplectic, m > 0);
    ASSERT_EQ(motion.rows, best.rows) << m;
    ASSERT_EQ(motion.sections.size(), best.sections.size()) << m;
    EXPECT_TRUE(m > 0 || motion.sections.size() >= 2);
    for (std::size_t i = 0; i < motion.sections.size(); ++i)
      EXPECT_NEAR(motion.sections[i].t, best.sections[i].t, 1e-8);
    EXPECT_LT(test::difference(motion, best), 1e-7) << m;
  }
}

TEST(GaussOnScenes, ForcesAndInputsActOnTheMomenta) {
  const Dynamics dynamics(test::model_of("forced_spring_pendulum"), {"0.8*cos(4*t) + 0.1*t"});
  SimulationRequest request = test::request_for(dynamics.model(), {}, test::instants(5, 50));
  const Simulation best = simulate(dynamics, request);
  request.method = Method::gauss;
  request.h = 2e-3;
  EXPECT_LT(test::difference(simulate(dynamics, request), best), 1e-10);
}

TEST(GaussOnScenes, StiffSpringIsSteppedOverOrNamed) {
  const auto model = test::model_of("spring_pendulum");
  std::size_t stepped_over = 0;
  for (const double k : {1e6, 1e9, 1e12}) {
    SimulationRequest request = test::request_for(
        *model, {{"m", 1}, {"k", k}, {"l0", 1}, {"l", 1 + 10 / k}, {"theta", 0.7}}, test::instants(10, 100));
    request.method = Method::gauss;
    request.h = 0.01;
    const MeasuredSimulation measured = simulate_with_error(Dynamics(model), request, {});
    if (measured.simulation.ending == Ending::no_convergence) continue;
    ASSERT_EQ(measured.simulation.ending, Ending::reached_end) << k;
    ++stepped_over;
    EXPECT_LT(std::abs(test::row(measured.simulation, 100)[0] - 1), 1e-3) << k;
    // The quick oscillation along the spring is lost, which its horizon says.
    EXPECT_TRUE(!measured.reason.empty() || measured.horizon || measured.max_abs_error[1] < 1e-2) << k;
  }
  EXPECT_GT(stepped_over, 0);
}

TEST(GaussOnScenes, TheLadderMeasuresTheErrorOfAStep) {
  // The isotropic oscillator: l^2 = (x0 cos wt)^2 + (v0/w sin wt)^2.
  const auto model = test::model_of("spring_pendulum");
  const std::vector<double> grid = test::instants(50, 101);
  SimulationRequest request = test::request_for(
      *model, {{"m", 0.5}, {"k", 8}, {"l0", 0}, {"g", 0}, {"l", 1.25}, {"theta", 0}, {"theta_dot", 2}}, grid);
  request.method = Method::gauss;
  for (const double h : {0.2, 0.05, 0.01, 1e-3}) {
    request.h = h;
    const MeasuredSimulation m = simulate_with_error(Dynamics(model), request, {});
    ASSERT_EQ(m.max_abs_error.size(), 4u);
    EXPECT_EQ(m.verified_by, Method::taylor);
    double error = 0;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const double exact = std::hypot(1.25 * std::cos(4 * grid[i]), 0.625 * std::sin(4 * grid[i]));
      error = std::max(error, std::abs(test::row(m.simulation, i)[0] - exact));
    }
    EXPECT_LE(error, m.max_abs_error[0]) << h;
    const double most =
        h == 0.2 ? 4 * 0.627 : 10 * error;  // there the motion is lost: four times the range of l it has
    EXPECT_LE(m.max_abs_error[0], std::max(most, 1e-11)) << h;
  }
  AccuracyGoal goal{.kind = AccuracyGoal::Kind::absolute, .value = 1e-6};
  EXPECT_THROW((void)simulate_with_error(Dynamics(model), request, goal), std::invalid_argument);
}

}  // namespace
}  // namespace qdot::gauss_test
