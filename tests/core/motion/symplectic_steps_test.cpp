// Methods that promise to be symplectic are, whichever there are: in the canonical variables of scenes.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "core/integrate/integrate.hpp"
#include "core/integrate/methods.hpp"
#include "tests/support/motions.hpp"

namespace qdot::symplectic_steps_test {
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
                                    Method method, double h, double t_end) {
  constexpr std::array<double, 4> weight{4. / 5, -1. / 5, 4. / 105, -1. / 280};
  constexpr double delta = 1e-2;
  std::vector<double> column(z.size());
  const double middle = z[k];
  for (std::size_t i = 0; i < weight.size(); ++i) {
    for (const double sign : {1., -1.}) {
      z[k] = middle + sign * delta * static_cast<double>(i + 1);
      const auto run = integrate(system, {.y_start = z, .t_end = t_end, .method = method, .h = h});
      for (std::size_t j = 0; j < z.size(); ++j) column[j] += sign * weight[i] * run.y[j] / delta;
    }
  }
  return column;
}

/// The largest entry of D^T J D - J, D the derivative of the flow over t_end and J = [0, 1; -1, 0].
double symplectic_defect(const RightHandSide& system, const std::vector<double>& z, Method method, double h,
                         double t_end) {
  const std::size_t n = z.size() / 2;
  std::vector<std::vector<double>> d;
  for (std::size_t k = 0; k < z.size(); ++k) d.push_back(flow_derivative(system, z, k, method, h, t_end));
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

/// Those that promise it in the words that users read.
std::vector<Method> symplectic_methods() {
  std::vector<Method> found;
  for (const MethodRecord& record : methods()) {
    if (record.has_fixed_step() && record.summary.find("symplectic") != std::string_view::npos)
      found.push_back(record.method);
  }
  return found;
}

class SymplecticSteps : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Methods, SymplecticSteps, testing::ValuesIn(symplectic_methods()),
                         [](const auto& given) { return std::string(record_of(given.param).name); });

TEST_P(SymplecticSteps, HaveASymplecticFlowInTheCanonicalVariables) {
  // With steps so coarse that the motion itself is wrong in the third digit. What is left is the error of
  // the differences, some 1e-16/delta and delta^8 times the ninth derivative.
  const std::vector<Case> cases{
      {"spring_pendulum", {{"m", 1}, {"k", 40}, {"l0", 1}, {"l", 1.3}, {"theta", 0.7}}, 0.25},
      {"free_spin_pendulum", {{"m", 1}, {"l", 1}, {"theta", 0.3}, {"theta_dot", 0.4}, {"psi_dot", 3}}, 0.25}};
  for (const auto& [name, given, h] : cases) {
    const Dynamics dynamics(test::model_of(name));
    const Start start = start_of(dynamics, given);
    const RightHandSide system = canonical_system(dynamics, start.parameters);
    EXPECT_LT(symplectic_defect(system, start.z, GetParam(), h, 2), 1e-9) << name;
    const RunRequest coarse{.y_start = start.z, .t_end = 2, .method = GetParam(), .h = h};
    RunRequest fine = coarse;
    fine.h = h / 32;
    EXPECT_GT(std::abs(integrate(system, coarse).y[1] - integrate(system, fine).y[1]), 1e-5) << name;
  }
}

TEST_P(SymplecticSteps, WouldNotHaveOneInVelocitiesInsteadOfMomenta) {
  // The test above can fail: the same method in (q, q') of the same motion, measured in (q, p).
  const Dynamics dynamics(test::model_of("spring_pendulum"));
  const Start start = start_of(dynamics, {{"m", 1}, {"k", 40}, {"l0", 1}, {"l", 1.3}, {"theta", 0.7}});
  RightHandSide in_velocities;
  in_velocities.dimension = 4;
  in_velocities.derivative = [&dynamics, workspace = dynamics.accelerations().bind(start.parameters)](
                                 double t, std::span<const double> y, std::span<double> out) mutable {
    std::copy_n(y.begin() + 2, 2, out.begin());
    return dynamics.accelerations().evaluate(t, y, workspace, out.subspan(2));
  };
  EXPECT_GT(symplectic_defect(in_velocities, start.y, GetParam(), 0.25, 2), 1e-3);
}

}  // namespace
}  // namespace qdot::symplectic_steps_test
