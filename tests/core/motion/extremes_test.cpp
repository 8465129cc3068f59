// Extreme parameters end with an answer or with a named ending, never with numbers that are none.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/motions.hpp"

namespace qdot {
namespace {

struct Extreme {
  std::string name, system;
  Values given;
  double t_end;
};

void PrintTo(const Extreme& extreme, std::ostream* out) { *out << extreme.name; }

const std::vector<Extreme> table{
    {"TinyMassOnASpring", "spring_pendulum", {{"m", 1e-300}}, 1},
    {"HugeMassOnASpring", "spring_pendulum", {{"m", 1e300}}, 1},
    {"StiffSpring", "spring_pendulum", {{"k", 1e9}, {"l", 0.37}}, 0.01},
    {"NoSpring", "spring_pendulum", {{"k", 0}}, 1},
    {"InfinitelyStiffSpring", "spring_pendulum", {{"k", 1e300}}, 1},
    {"HugeGravity", "spring_pendulum", {{"g", 1e300}}, 1},
    {"EverythingTiny", "spring_pendulum", {{"m", 1e-300}, {"k", 1e-300}, {"g", 1e-300}}, 1},
    {"FastStart", "spring_pendulum", {{"theta_dot", 1e200}}, 1},
    {"PlatformAtRest", "rolling_disk_platform", {{"Omega", 0}}, 1},
    {"PlatformLikeATurbine", "rolling_disk_platform", {{"Omega", 1e6}, {"q_dot", 1e6}}, 1e-3},
    {"ShaftAtRest", "whirling_pendulum", {{"Omega", 0}}, 5},
    {"ShaftLikeATurbine", "whirling_pendulum", {{"Omega", 1e6}}, 1e-3},
    {"HugeShaftRate", "whirling_pendulum", {{"Omega", 1e300}}, 1},
    {"ShortPendulum", "whirling_pendulum", {{"l", 1e-300}}, 1},
    {"LongRod", "rod_pendulum", {{"l", 1e300}}, 1},
    {"WeightlessRod", "rod_pendulum", {{"m", 1e-300}}, 1},
    {"HeavyRod", "rod_pendulum", {{"m", 1e300}}, 1},
    {"CartWithoutMass", "cart_pendulum", {{"M", 1e-300}, {"k", 0}}, 1},
    {"BobWithoutMass", "cart_pendulum", {{"m", 1e-300}, {"M", 1}, {"k", 10}}, 1},
    {"CartAndBobHeavy", "cart_pendulum", {{"m", 1e300}, {"M", 1e300}, {"k", 1e300}}, 1},
    {"PostLikeATurbine", "rotating_l_bar", {{"Omega", 1e6}}, 1e-4},
    {"AlmostMasslessFeet", "compass_walker", {{"m", 1e-300}}, 3},
    {"AlmostMasslessHip", "compass_walker", {{"M", 1e-300}, {"m", 1}}, 1},
    {"VerticalSlope", "compass_walker", {{"gamma", 1.6}}, 5},
    {"ForeverASpring", "spring_pendulum", {}, 1e300},
    {"ForeverAWalk", "compass_walker", {}, 1e300},
    {"ForeverRolling", "rolling_disk_platform", {{"g", 0}}, 1e300},
    {"AnInstant", "spring_pendulum", {}, 1e-300},
    {"SunInTheFace", "kepler", {{"r", 1e-12}, {"theta_dot", 0}}, 1},
    {"StillOnTheAxis", "free_spin_pendulum", {{"theta", -0.5235987755982988}, {"psi_dot", 1e-9}}, 1},
};

class ExtremeMotion : public testing::TestWithParam<Extreme> {};
INSTANTIATE_TEST_SUITE_P(Table, ExtremeMotion, testing::ValuesIn(table),
                         [](const auto& info) { return info.param.name; });

void expect_numbers(std::span<const double> values, const std::string& what) {
  for (const double value : values) ASSERT_TRUE(std::isfinite(value)) << what;
}

TEST_P(ExtremeMotion, HasNumbersOrANamedEnding) {
  const auto model = test::model_of(GetParam().system);
  const Dynamics dynamics(model);
  for (const Method method : test::all_methods) {
    SimulationRequest request =
        test::request_for(*model, GetParam().given, test::instants(GetParam().t_end, 10));
    request.method = method;
    request.tolerances = {1e-8, 1e-10};
    request.limits.max_evaluations = 50'000;
    request.columns = test::energy_columns(*model);
    try {
      const Simulation motion = simulate(dynamics, request);
      expect_numbers(motion.states, "states");
      expect_numbers(motion.y, "last state");
      expect_numbers({&motion.t, 1}, "time");
      expect_numbers(motion.columns, "columns");
      EXPECT_LE(motion.t, request.t_end);
      for (const ConservedRecord& record : motion.conserved) {
        expect_numbers({&record.initial, 1}, record.name);
        expect_numbers({&record.max_abs_drift, 1}, record.name);
      }
      for (const EventRecord& event : motion.events) expect_numbers(event.y, event.name);
      EXPECT_EQ(motion.ending == Ending::reached_end, motion.rows == request.grid.size());
      EXPECT_EQ(motion.ending == Ending::event, motion.stop.has_value());
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_state) << error.what();
    }
  }
}

TEST(ExtremeMass, OfAWholeSystemDoesNotChangeItsMotion) {
  const std::vector<double> grid = test::instants(2, 20);
  const Simulation plain = test::motion_of("rod_pendulum", {}, grid);
  for (const double m : {1e-300, 1e300})
    EXPECT_EQ(test::motion_of("rod_pendulum", {{"m", m}}, grid).states, plain.states) << m;
}

TEST(ExtremeMass, LeavesAMotionBounded) {
  const auto model = test::model_of("rod_pendulum");
  for (const double m : {1e-300, 1e300}) {
    SimulationRequest request = test::request_for(*model, {{"m", m}}, test::instants(1, 2));
    request.method = Method::taylor;
    EXPECT_TRUE(simulate(Dynamics(model), request).bounded) << m;
  }
}

TEST(ExtremeMass, OfTheFeetGoesOverIntoNone) {
  const std::vector<double> grid = test::instants(5, 50);
  const Simulation none = test::motion_of("compass_walker", {{"m", 0}}, grid);
  EXPECT_EQ(none.rows, grid.size());
  for (const double m : {1e-300, 1e-18})
    EXPECT_LT(test::difference(test::motion_of("compass_walker", {{"m", m}}, grid), none), 1e-11) << m;
}

TEST(ExtremeEnd, DoesNotHideWhatHappensBefore) {
  const auto model = test::model_of("plane_pendulum");
  const auto first_passage = [&](double t_end) {
    SimulationRequest request = test::request_for(*model, {}, {0, t_end});
    request.events = {"theta = 0-"};
    request.limits.max_evaluations = 50'000;
    const Simulation motion = simulate(Dynamics(model), request);
    return motion.events.empty() ? 0 : motion.events[0].t;
  };
  for (const double t_end : {1e3, 1e6, 1e12, 1e300})
    EXPECT_NEAR(first_passage(t_end), first_passage(10), 1e-9) << t_end;
}

/// The bob hangs m g/k below l0 and swings like a plane pendulum of that length.
TEST(StiffSpring, SwingsLikeARod) {
  const double k = 1e5, m = 0.5, g = 9.81, l0 = 0.37;
  const auto model = test::model_of("spring_pendulum");
  SimulationRequest request =
      test::request_for(*model, {{"k", k}, {"l", l0 + m * g / k}, {"theta", 0.1}}, {0, 0.4});
  request.events = {"theta = 0-"};
  const Simulation motion = simulate(Dynamics(model), request);
  ASSERT_EQ(motion.events.size(), 1u);
  const double quarter = std::comp_ellint_1(std::sin(0.05)) * std::sqrt((l0 + m * g / k) / g);
  EXPECT_NEAR(motion.events[0].t, quarter, 10 * m * g / k / l0 * quarter);  // the spring gives by m g/k
}

}  // namespace
}  // namespace qdot
