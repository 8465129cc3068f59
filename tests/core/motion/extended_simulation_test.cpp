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

/// The same motion in a unit of time that is a power of two of seconds.
ExtendedSimulationRequest fast_pendulum(const Model& model, int exponent) {
  const auto times = [](const Real& x, int power) {
    return Real{std::ldexp(x.value, power), std::ldexp(x.low, power), std::ldexp(x.error, power)};
  };
  ExtendedSimulationRequest request = plane_pendulum(model, times(decimal("9.81"), 2 * exponent));
  request.y_start.set(1, times(request.y_start.exact(1), exponent));
  request.grid = Reals();
  request.grid.push_back(times(decimal("7.3"), -exponent));
  return request;
}

TEST(ExtendedSimulation, FollowsAMotionAsFastAsAnElectronsLikeAnyOther) {
  const auto model = test::model_of("plane_pendulum");
  const Dynamics dynamics(model);
  const ExtendedSimulation slow = extended_simulation(dynamics, fast_pendulum(*model, 0));
  for (const int exponent : {30, 36, 40, 44, 50, 60, 75, 90}) {
    const ExtendedSimulation fast = extended_simulation(dynamics, fast_pendulum(*model, exponent));
    ASSERT_EQ(fast.max_abs_error.size(), 2u) << exponent;
    EXPECT_TRUE(fast.bounded) << exponent;
    const double error = std::abs((fast.run.states[0] - angle).high);
    EXPECT_LE(error, fast.max_abs_error[0]) << exponent;
    EXPECT_LE(fast.max_abs_error[0], 2 * slow.max_abs_error[0]) << exponent;
    EXPECT_LE(fast.max_abs_error[1], std::ldexp(2 * slow.max_abs_error[1], exponent)) << exponent;
    EXPECT_LE(fast.run.steps, slow.run.steps + 2) << exponent;
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
