// The error that a motion in double-doubles states is the one it has.

#include "core/motion/extended_simulation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/expr/number.hpp"
#include "tests/support/motions.hpp"

namespace qdot {
namespace {

Real decimal(const char* text) { return Number::written(text)->rounded(); }

ExtendedSimulationRequest plane_pendulum(const Model& model, Real g) {
  const RealValues given{
      {"m", 1.0}, {"l", decimal("0.7")}, {"g", g}, {"theta", decimal("1.1")}, {"theta_dot", decimal("0.3")}};
  ExtendedSimulationRequest request;
  request.parameters = parameter_values(model, given);
  request.y_start = initial_state(model, request.parameters, given);
  request.grid.push_back(decimal("7.3"));
  return request;
}

/// By mpmath with 45 digits, series of orders 50 and 60.
const DoubleDouble angle = decimal("1.102607563344723785776242952123083").double_double();

TEST(ExtendedSimulation, StatesItsErrorAndMeetsWhatIsWanted) {
  const auto model = test::model_of("plane_pendulum");
  const Dynamics dynamics(model);
  for (const double wanted : {1e-16, 1e-20, 1e-24, 1e-28}) {
    ExtendedSimulationRequest request = plane_pendulum(*model, decimal("9.81"));
    request.max_error = wanted;
    const ExtendedSimulation motion = extended_simulation(dynamics, request);
    ASSERT_EQ(motion.max_abs_error.size(), 2u);
    const double error = std::abs((motion.run.states[0] - angle).high);
    EXPECT_LE(error, motion.max_abs_error[0]);
    EXPECT_LE(motion.max_abs_error[0], wanted);
    EXPECT_EQ(motion.meets_request, true);
    EXPECT_TRUE(motion.bounded);
  }
}

TEST(ExtendedSimulation, SaysWhenTheErrorWantedIsOutOfReach) {
  const auto model = test::model_of("plane_pendulum");
  ExtendedSimulationRequest request = plane_pendulum(*model, decimal("9.81"));
  request.max_error = 1e-33;
  const ExtendedSimulation motion = extended_simulation(Dynamics(model), request);
  EXPECT_EQ(motion.meets_request, false);
  EXPECT_FALSE(motion.reason.empty());
}

TEST(ExtendedSimulation, CountsWhatIsNotKnownOfAParameter) {
  const auto model = test::model_of("plane_pendulum");
  const Real exact = decimal("9.81");
  const double unknown = 1e-20;
  const ExtendedSimulation motion =
      extended_simulation(Dynamics(model), plane_pendulum(*model, {exact.value, exact.low, unknown}));
  // dtheta/dg is of the order of the time over g.
  EXPECT_GT(motion.max_abs_error[0], 0.1 * unknown);
  EXPECT_LT(motion.max_abs_error[0], 1e3 * unknown);
}

}  // namespace
}  // namespace qdot
