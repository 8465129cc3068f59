// Gauss's method on scenes: symplectic in canonical variables, bounded energy errors, the same motions.

#include <gtest/gtest.h>

#include <cmath>

#include "core/integrate/integrate.hpp"
#include "core/motion/ladder.hpp"
#include "tests/support/motions.hpp"
#include "tests/support/system_test.hpp"

namespace qdot::gauss_test {
namespace {

/// A scene's canonical equations as a system of their own.
RightHandSide canonical_system(const Dynamics& dynamics, const std::vector<double>& parameters) {
  const CanonicalFunctions& functions = *dynamics.canonical();
  RightHandSide system;
  system.dimension = 2 * dynamics.model().degrees_of_freedom();
  system.derivative = [&functions, workspace = functions.derivative().bind(parameters)](
                          double t, std::span<const double> z, std::span<double> out) mutable {
    return functions.derivative().evaluate(t, z, workspace, out);
  };
  system.jacobian = [&functions, workspace = functions.bind_jacobian(parameters)](
                        double t, std::span<const double> z, std::span<double> out) mutable {
    return functions.jacobian(t, z, workspace, out);
  };
  return system;
}

struct Start {
  std::vector<double> parameters, y, z;
};

Start start_of(const Dynamics& dynamics, const Values& given) {
  Start start;
  start.parameters = parameter_values(dynamics.model(), given);
  start.y = initial_state(dynamics.model(), start.parameters, given);
  const CompiledFunction& momenta = dynamics.canonical()->momenta();
  Workspace workspace = momenta.bind(start.parameters);
  const std::size_t n = start.y.size() / 2;
  start.z = start.y;
  EXPECT_EQ(momenta.evaluate(0, start.y, workspace, std::span(start.z).subspan(n)), Evaluation::ok);
  return start;
}

/// d(end)/d(start)_k by central differences of order eight.
std::vector<double> flow_derivative(const RightHandSide& system, std::vector<double> z, std::size_t k,
                                    double h, double t_end) {
  constexpr std::array<double, 4> weight{4. / 5, -1. / 5, 4. / 105, -1. / 280};
  constexpr double delta = 1e-2;
  std::vector<double> column(z.size());
  const double middle = z[k];
  for (std::size_t i = 0; i < weight.size(); ++i) {
    for (const double sign : {1., -1.}) {
      z[k] = middle + sign * delta * static_cast<double>(i + 1);
      const auto run = integrate(system, {.y_start = z, .t_end = t_end, .method = Method::gauss, .h = h});
      for (std::size_t j = 0; j < z.size(); ++j) column[j] += sign * weight[i] * run.y[j] / delta;
    }
  }
  return column;
}

/// The largest entry of D^T J D - J, D the derivative of the flow over t_end and J = [0, 1; -1, 0].
double symplectic_defect(const RightHandSide& system, const std::vector<double>& z, double h, double t_end) {
  const std::size_t n = z.size() / 2;
  std::vector<std::vector<double>> d;
  for (std::size_t k = 0; k < z.size(); ++k) d.push_back(flow_derivative(system, z, k, h, t_end));
  double largest = 0;
  for (std::size_t a = 0; a < z.size(); ++a) {
    for (std::size_t b = 0; b < z.size(); ++b) {
      double form = 0;
      for (std::size_t i = 0; i < n; ++i) form += d[a][i] * d[b][n + i] - d[a][n + i] * d[b][i];
      const double expected = b == a + n ? 1 : a == b + n ? -1 : 0;
      largest = std::max(largest, std::abs(form - expected));
    }
  }
  return largest;
}

struct Case {
  const char* system;
  Values given;
  double h;
};

TEST(GaussOnScenes, FlowIsSymplecticInTheCanonicalVariables) {
  // With steps so coarse that the motion itself is wrong in the third digit. What is left is the error of
  // the differences, some 1e-16/delta and delta^8 times the ninth derivative.
  const std::vector<Case> cases{
      {"spring_pendulum", {{"m", 1}, {"k", 40}, {"l0", 1}, {"l", 1.3}, {"theta", 0.7}}, 0.25},
      {"free_spin_pendulum", {{"m", 1}, {"l", 1}, {"theta", 0.3}, {"theta_dot", 0.4}, {"psi_dot", 3}}, 0.25}};
  for (const auto& [name, given, h] : cases) {
    const Dynamics dynamics(test::model_of(name));
    const Start start = start_of(dynamics, given);
    const RightHandSide system = canonical_system(dynamics, start.parameters);
    EXPECT_LT(symplectic_defect(system, start.z, h, 2), 1e-9) << name;
    const RunRequest coarse{.y_start = start.z, .t_end = 2, .method = Method::gauss, .h = h};
    RunRequest fine = coarse;
    fine.h = h / 32;
    EXPECT_GT(std::abs(integrate(system, coarse).y[1] - integrate(system, fine).y[1]), 1e-5) << name;
  }
}

TEST(GaussOnScenes, VelocitiesInsteadOfMomentaWouldNotBeSymplectic) {
  // The test above can fail: the same method in (q, q') of the same motion, measured in (q, p).
  const Dynamics dynamics(test::model_of("spring_pendulum"));
  const Start start = start_of(dynamics, {{"m", 1}, {"k", 40}, {"l0", 1}, {"l", 1.3}, {"theta", 0.7}});
  RightHandSide system = canonical_system(dynamics, start.parameters);
  RightHandSide in_velocities;
  in_velocities.dimension = 4;
  in_velocities.derivative = [&dynamics, workspace = dynamics.accelerations().bind(start.parameters)](
                                 double t, std::span<const double> y, std::span<double> out) mutable {
    std::copy_n(y.begin() + 2, 2, out.begin());
    return dynamics.accelerations().evaluate(t, y, workspace, out.subspan(2));
  };
  EXPECT_GT(symplectic_defect(in_velocities, start.y, 0.25, 2), 1e-3);
}

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
  // At a step that is exact but for rounding: 1e5 steps of 1e-16 each, were they all of one sign, come to
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
