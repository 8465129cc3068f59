// Compiled dynamics: inputs, the Jacobian, events and columns.

#include "core/dynamics/dynamics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <latch>
#include <thread>

#include "tests/support/agreement.hpp"
#include "tests/support/motions.hpp"
#include "tests/support/system_test.hpp"

namespace qdot {
namespace {

/// A pendulum whose pivot a request moves sideways: l theta'' + u'' cos(theta) + g sin(theta) = 0.
std::shared_ptr<const Model> pendulum_on_a_moved_pivot() {
  Scene scene = test::scene_of("plane_pendulum");
  scene.inputs.push_back({"u", "m", "0", ""});
  scene.points[0].components[0] = "u";
  scene.points[1].components[0] = "u + l*sin(theta)";
  return build_model(scene);
}

TEST(Dynamics, InputsInPositionsActByTheirAccelerations) {
  const auto model = pendulum_on_a_moved_pivot();
  const Dynamics dynamics(model, {"l*sin(3*t)"});
  test::Random random(8);
  for (int i = 0; i < test::identity_states; ++i) {
    const Values state = test::random_state(*model, random);
    const double theta = state.at("theta"), g = state.at("g"), l = state.at("l");
    const test::Terms expected{9 * std::sin(3 * state.at("t")) * std::cos(theta), -g / l * std::sin(theta)};
    EXPECT_TRUE(test::agrees(test::outputs_of(dynamics.accelerations(), *model, state)[0], expected));
  }
}

TEST(Dynamics, InputsByDefaultAreTheScenes) {
  const auto model = pendulum_on_a_moved_pivot();
  const auto plain = test::model_of("plane_pendulum");
  test::Random random(9);
  const Values state = test::random_state(*plain, random);
  const double expected = test::outputs_of(Dynamics(plain).accelerations(), *plain, state)[0];
  EXPECT_EQ(test::outputs_of(Dynamics(model).accelerations(), *model, state)[0], expected);
  EXPECT_EQ(test::outputs_of(Dynamics(model, {""}).accelerations(), *model, state)[0], expected);
}

TEST(Dynamics, RefusesInputsThatItCannotRead) {
  const auto model = test::model_of("forced_spring_pendulum");
  const auto code = [&](const std::string& input) {
    try {
      (void)Dynamics(model, {input});
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::not_applicable;  // accepted
  };
  EXPECT_EQ(code("m*cos("), ErrorCode::syntax);
  EXPECT_EQ(code("A*cos(t)"), ErrorCode::unknown_symbol);
  EXPECT_EQ(code("theta"), ErrorCode::unknown_symbol);  // a function of time, not of the state
  EXPECT_EQ(code(std::string(5000, ' ') + "1"), ErrorCode::too_large);
  EXPECT_EQ(code("m*g*cos(k/m*t^2)"), ErrorCode::not_applicable);
}

class CompiledJacobian : public test::SystemTest {};
INSTANTIATE_TEST_SUITE_P(Systems, CompiledJacobian, testing::ValuesIn(test::all_systems()),
                         test::system_name);

/// Central differences of step h are off by h^2 y'''/6, about 1e-10 times derivatives of order ten to a
/// thousand here, and by round-off eps/h.
TEST_P(CompiledJacobian, IsTheDerivativeOfTheAccelerations) {
  const std::vector<std::string> inputs(model().scene.inputs.size(), "m*cos(3*t)");
  const Dynamics dynamics(test::model_of(GetParam()), inputs);
  const std::size_t n = model().degrees_of_freedom();
  constexpr double h = 1e-5;
  each_state(
      [&](const Values& state) {
        const std::vector<double> jacobian = test::outputs_of(dynamics.jacobian(), model(), state);
        for (std::size_t j = 0; j < 2 * n; ++j) {
          const std::string name = model().scene.coordinates[j % n].name + (j < n ? "" : "_dot");
          const auto shifted = [&](double step) {
            Values near = state;
            near[name] += step;
            return test::outputs_of(dynamics.accelerations(), model(), near);
          };
          const std::vector<double> above = shifted(h), below = shifted(-h);
          for (std::size_t i = 0; i < n; ++i) {
            EXPECT_EQ(jacobian[i * 2 * n + j], j == n + i ? 1 : 0);
            const double slope = (above[i] - below[i]) / (2 * h);
            const double size = 1 + std::abs(slope) + std::abs(above[i]);
            EXPECT_NEAR(jacobian[(n + i) * 2 * n + j], slope, 1e-5 * size * size) << i << name;
          }
        }
      },
      20);
}

TEST(Dynamics, ReadsEventsByTextOrByTheScenesNames) {
  const Dynamics walker(test::model_of("compass_walker"));
  EXPECT_EQ(walker.event("phi - 2*theta = 0+").direction, walker.event("heel_strike").direction);
  EXPECT_TRUE(walker.event("heel_strike").when.has_value());
  EXPECT_FALSE(walker.event("scuff").when.has_value());
  EXPECT_THROW((void)walker.event("stumble"), Error);
  EXPECT_THROW((void)walker.event("theta_ddot = 0"), Error);
}

TEST(Dynamics, NamesItsColumns) {
  const auto names = [](const std::vector<Column>& columns) {
    std::string all;
    for (const Column& column : columns) all += column.name + "[" + column.unit + "] ";
    return all;
  };
  const Model& rod = *test::model_of("rod_spring_pendulum");
  EXPECT_EQ(names(momentum_columns(rod)), "p_theta[kg*m^2/s] p_phi[kg*m^2/s] p_r[kg*m/s] ");
  EXPECT_EQ(names(acceleration_columns(rod)), "theta_ddot[rad/s^2] phi_ddot[rad/s^2] r_ddot[m/s^2] ");
  EXPECT_EQ(names(position_columns(rod)),
            "pivot_x[m] pivot_y[m] rod_end_x[m] rod_end_y[m] bob_x[m] bob_y[m] ");
  EXPECT_EQ(names(validity_columns(*test::model_of("rod_pendulum"))), "tension[N] ");
}

TEST(ValuesAt, SaysWhichColumnHasNoValue) {
  const auto model = test::model_of("kepler");
  const SimulationRequest sunk = test::request_for(*model, {{"r", 0}}, {0});
  try {
    (void)values_at(Dynamics(model), test::energy_columns(*model), sunk.parameters, 0, sunk.y_start);
    FAIL() << "a value at r = 0";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::invalid_state);
    EXPECT_STREQ(error.what(), "In this state there is no finite value of V, energy, h.");
  }
}

TEST(ValuesAt, SaysWhereTheMassMatrixIsSingular) {
  const auto model = test::model_of("cart_pendulum");
  for (const double M : {0.0, 1e-17}) {  // nothing, or nothing beside the bob's half kilogram
    const SimulationRequest hanging = test::request_for(*model, {{"M", M}, {"theta", 0}, {"m", 0.5}}, {0});
    try {
      (void)values_at(Dynamics(model), acceleration_columns(*model), hanging.parameters, 0, hanging.y_start);
      FAIL() << "accelerations of a massless cart above its pendulum";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_state);
      EXPECT_STREQ(error.what(), "The mass matrix has no inverse in this state.");
    }
  }
}

TEST(Dynamics, GivesTheSameBitsInEightThreads) {
  const auto model = test::model_of("triple_pendulum");
  const Dynamics dynamics(model);  // compiled by whichever thread comes first
  const SimulationRequest request = test::request_for(*model, {}, test::instants(1, 10));
  std::vector<std::vector<double>> states(8);
  std::vector<std::thread> threads;
  for (auto& result : states) threads.emplace_back([&] { result = simulate(dynamics, request).states; });
  for (std::thread& thread : threads) thread.join();
  for (const auto& result : states) EXPECT_EQ(result, states[0]);
  EXPECT_EQ(states[0].size(), 66u);
}

/// A test that waited for the derivation would hang.
TEST(Dynamics, AnswersALightQuestionWhileAnotherIsStillBeingDerived) {
  const auto model = test::model_of("spring_pendulum");
  const Dynamics dynamics(model);
  const SimulationRequest request = test::request_for(*model, {}, {0});
  std::latch began(1), go_on(1);
  std::thread heavy([&] {
    (void)dynamics.derived<int>("heavy", request.parameters, [&](const Statics&) {
      began.count_down();
      go_on.wait();
      return 1;
    });
  });
  began.wait();
  EXPECT_EQ(values_at(dynamics, test::energy_columns(*model), request.parameters, 0, request.y_start).size(),
            4u);
  EXPECT_EQ(dynamics.accelerations().outputs(), model->degrees_of_freedom());
  EXPECT_EQ(*dynamics.derived<int>("light", request.parameters, [](const Statics&) { return 2; }), 2);
  go_on.count_down();
  heavy.join();
  EXPECT_EQ(*dynamics.derived<int>("heavy", request.parameters, [](const Statics&) { return 3; }), 1);
}

}  // namespace
}  // namespace qdot
