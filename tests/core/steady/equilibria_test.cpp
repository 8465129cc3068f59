// Equilibria against closed forms and theory, for random parameters and at the edges of what doubles tell
// apart.

#include "core/steady/equilibria.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "tests/support/motions.hpp"
#include "tests/support/random.hpp"

namespace qdot {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double round_off = 1e-12;

Equilibria equilibria_of(const std::string& system, const Values& given) {
  const auto model = test::model_of(system);
  const Dynamics dynamics(model);
  const std::vector<double> parameters = parameter_values(*model, given);
  return equilibria(dynamics, parameters, initial_state(*model, parameters, given));
}

/// The first coordinates, ascending.
std::vector<double> places(const Equilibria& found) {
  std::vector<double> result;
  for (const SteadyState& state : found.states) result.push_back(state.y[0]);
  return result;
}

void expect_place(const SteadyState& state, long double expected, Stability stability) {
  EXPECT_LE(std::abs(state.y[0] - expected), state.errors[0] + 1e-18L) << state.y[0];
  EXPECT_LT(state.errors[0], 1e-13);
  EXPECT_EQ(state.stability.stability, stability);
}

TEST(AllEquilibria, OfTheWhirlingPendulumAreTwoOrFour) {
  test::Random random(1);
  for (int i = 0; i < 60; ++i) {
    const double g = random.real(1, 20), l = random.real(0.2, 2), omega = random.real(-8, 8);
    const Equilibria found = equilibria_of("whirling_pendulum", {{"g", g}, {"l", l}, {"Omega", omega}});
    ASSERT_TRUE(found.complete);
    const long double cosine = static_cast<long double>(g) / (static_cast<long double>(l) * omega * omega);
    if (cosine >= 1) {
      ASSERT_EQ(found.states.size(), 2U);
      expect_place(found.states[0], 0, Stability::stable);
      EXPECT_EQ(found.states[1].y[0], pi);
      continue;
    }
    ASSERT_EQ(found.states.size(), 4U);
    expect_place(found.states[0], -std::acos(cosine), Stability::stable);
    expect_place(found.states[1], 0, Stability::unstable);
    expect_place(found.states[2], std::acos(cosine), Stability::stable);
    EXPECT_EQ(found.states[3].stability.stability, Stability::unstable);
    const double rate2 = omega * omega * static_cast<double>(1 - cosine * cosine);
    EXPECT_NEAR(found.states[2].stability.rate2->middle(), rate2, 1e-10 * omega * omega);
    EXPECT_EQ(found.states[1].errors[0], 0);  // exactly zero, and known to be
  }
}

TEST(AllEquilibria, OfTheLBarAreTwoBelowItsFoldAndFourAbove) {
  constexpr double fold = 0.46257442562035035824;  // Omega^2 l/g
  test::Random random(2);
  for (int i = 0; i < 300; ++i) {
    const double g = random.real(1, 20), l = random.real(0.2, 2);
    const double square = random.real(0, 1.5) * g / l;
    const Equilibria found =
        equilibria_of("rotating_l_bar", {{"g", g}, {"l", l}, {"Omega", std::sqrt(square)}});
    ASSERT_TRUE(found.complete);
    ASSERT_EQ(found.states.size(), square * l / g < fold ? 2U : 4U);
    for (const SteadyState& state : found.states) {
      ASSERT_LT(state.errors[0], 1e-9);  // a proof may come from a box that hardly contracts
      const double th = state.y[0];
      const double force = square * (53 / 3.0 * std::sin(th) * std::cos(th) - 1.5 * std::cos(2 * th)) -
                           g / l * (7.5 * std::sin(th) - std::cos(th) / 2);
      EXPECT_NEAR(force, 0, round_off * (square + g / l) * 20);
    }
  }
}

TEST(AllEquilibria, AreNarrowAlsoWhereTheProofComesFromABoxThatHardlyContracts) {
  const Equilibria found = equilibria_of(
      "rotating_l_bar", {{"l", 1.8225694237006704}, {"g", 1.581209677637517}, {"Omega", 0.6946041982463963}});
  ASSERT_EQ(found.states.size(), 4U);
  for (const SteadyState& state : found.states) EXPECT_LT(state.errors[0], 1e-14);
  EXPECT_NEAR(found.states[2].y[0], 0.1381687914901912, 1e-13);
}

TEST(AllEquilibria, ResolveTheFoldToNineDigits) {
  const double g = 9.81, l = 0.5;
  const double fold = std::sqrt(0.46257442562035035824 * g / l);
  EXPECT_EQ(equilibria_of("rotating_l_bar", {{"g", g}, {"l", l}, {"Omega", fold * (1 - 1e-9)}}).states.size(),
            2U);
  const Equilibria above =
      equilibria_of("rotating_l_bar", {{"g", g}, {"l", l}, {"Omega", fold * (1 + 1e-9)}});
  ASSERT_EQ(above.states.size(), 4U);
  EXPECT_EQ(above.states[2].stability.stability, Stability::unstable);
  EXPECT_EQ(above.states[3].stability.stability, Stability::stable);
  const Equilibria at = equilibria_of("rotating_l_bar", {{"g", g}, {"l", l}, {"Omega", fold}});
  ASSERT_EQ(at.states.size(), 3U);  // two that cannot be told apart, or none
  EXPECT_FALSE(at.states[2].simple);
  EXPECT_EQ(at.states[2].stability.stability, Stability::neutral);
  EXPECT_LE(std::abs(at.states[2].y[0] - 0.33829126264813825728), at.states[2].errors[0]);
  EXPECT_LT(at.states[2].errors[0], 1e-6);
}

TEST(AllEquilibria, ResolveThePitchforkToNineDigits) {
  const Values scene{{"g", 9}, {"l", 1}};  // critical at exactly 3
  const auto at = [&](double omega) {
    Values given = scene;
    given["Omega"] = omega;
    return equilibria_of("whirling_pendulum", given);
  };
  EXPECT_EQ(at(3 * (1 - 1e-9)).states.size(), 2U);
  const Equilibria above = at(3 * (1 + 1e-9));
  ASSERT_EQ(above.states.size(), 4U);
  EXPECT_NEAR(above.states[2].y[0], std::sqrt(4e-9), 1e-8);
  const Equilibria critical = at(3);
  ASSERT_EQ(critical.states.size(), 2U);
  EXPECT_EQ(critical.states[0].y[0], 0);
  EXPECT_EQ(critical.states[0].stability.stability, Stability::neutral);
  EXPECT_THAT(critical.states[0].stability.undecided, testing::HasSubstr("nonlinearly stable"));
}

TEST(AllEquilibria, ASpinningArmsConesKeepTheirMomentum) {
  test::Random random(3);
  const auto model = test::model_of("free_spin_pendulum");
  const Dynamics dynamics(model);
  for (int i = 0; i < 30; ++i) {
    const Values given{{"g", random.real(1, 20)},
                       {"l", random.real(0.2, 2)},
                       {"theta", random.real(0, 1)},
                       {"psi_dot", random.real(0.1, 10)}};
    const std::vector<double> parameters = parameter_values(*model, given);
    const std::vector<double> y = initial_state(*model, parameters, given);
    const Equilibria found = equilibria(dynamics, parameters, y);
    ASSERT_TRUE(found.complete);
    ASSERT_GE(found.states.size(), 2U);
    for (const SteadyState& state : found.states) {
      const auto momentum = [](std::span<const double> at) {
        return std::pow(0.5 + std::sin(at[0]), 2) * at[3];
      };
      EXPECT_NEAR(momentum(state.y) / momentum(y), 1, 1e-9);
    }
  }
}

TEST(AllEquilibria, StayPut) {
  for (const std::string& system : test::practice_systems()) {
    if (system == "rolling_disk_platform") continue;
    const auto model = test::model_of(system);
    const Dynamics dynamics(model);
    const std::vector<double> parameters = parameter_values(*model, {});
    const Equilibria found = equilibria(dynamics, parameters, initial_state(*model, parameters, {}));
    ASSERT_FALSE(found.states.empty()) << system;
    for (const SteadyState& state : found.states) {
      SimulationRequest request = test::request_for(*model, {}, test::instants(0.2, 2));
      request.y_start = state.y;
      request.impacts = Impacts::ignore;
      request.on_invalid = OnInvalid::go_on;
      const Simulation motion = simulate(dynamics, request);
      ASSERT_EQ(motion.ending, Ending::reached_end) << system;
      for (const std::size_t i : found.problem.statics->reduction.kept) {
        EXPECT_NEAR(motion.y[i], state.y[i], 1e-11 * (1 + std::abs(state.y[i]))) << system;
      }
    }
  }
}

TEST(AllEquilibria, OfSeveralCoordinatesAreAllThere) {
  EXPECT_EQ(equilibria_of("rod_pendulum", {}).states.size(), 4U);
  EXPECT_EQ(equilibria_of("triple_pendulum", {}).states.size(), 8U);
  const Equilibria spring =
      equilibria_of("spring_pendulum", {{"m", 0.5}, {"k", 40}, {"l0", 0.37}, {"g", 9.81}});
  ASSERT_EQ(spring.states.size(), 2U);
  EXPECT_NEAR(spring.states[1].y[0], 0.37 + 0.5 * 9.81 / 40, 1e-15);
  EXPECT_EQ(spring.states[1].stability.stability, Stability::stable);
  EXPECT_EQ(spring.states[0].stability.stability, Stability::unstable);
  EXPECT_EQ(
      equilibria_of("spring_pendulum", {{"m", 0.5}, {"k", 10}, {"l0", 0.37}, {"g", 9.81}}).states.size(), 1U);
  const Equilibria walker = equilibria_of("compass_walker", {{"m", 0}});
  ASSERT_EQ(walker.states.size(), 4U);
  EXPECT_EQ(walker.states[2].y[0], 0.009);
  EXPECT_EQ(walker.states[2].stability.stability, Stability::unstable);
}

TEST(AllEquilibria, ExtremeMassRatiosChangeNothing) {
  for (const double mass : {1e-12, 1e12}) {
    const Equilibria found = equilibria_of("cart_pendulum", {{"M", mass}, {"m", 1}});
    ASSERT_EQ(found.states.size(), 2U) << mass;
    EXPECT_EQ(found.states[0].stability.stability, Stability::stable);
    EXPECT_EQ(found.states[1].stability.stability, Stability::unstable);
  }
}

TEST(AllEquilibria, CoordinatesThatNoForceDependsOnAreFree) {
  const Equilibria found = equilibria_of("rod_pendulum", {{"g", 0}});
  EXPECT_EQ(found.free, (std::vector<std::size_t>{0, 1}));
  ASSERT_EQ(found.states.size(), 1U);
  EXPECT_EQ(found.states[0].stability.stability, Stability::neutral);
}

/// x stands in no force, though it changes the inertia of y: no momentum belongs to it.
Equilibria beside_a_drifting_coordinate(const std::string& potential) {
  const auto model = test::model_written(
      R"json({"name": "drift", "units": "none", "parameters": [{"name": "k", "default": "3"}],
        "coordinates": [{"name": "x", "initial": "1/5"}, {"name": "y", "initial": "0"}],
        "lagrangian": "(x_dot^2 + (1 + x^2)*y_dot^2)/2 - )json" +
      potential + "\"}");
  const Reals parameters = parameter_values(*model, {});
  return equilibria(Dynamics(model), parameters, initial_state(*model, parameters, {}));
}

TEST(AllEquilibria, ACoordinateThatOnlyInertiaDependsOnLeavesTheOthersStable) {
  const Equilibria well = beside_a_drifting_coordinate("k*y^2/2");
  ASSERT_EQ(well.states.size(), 1U);
  EXPECT_EQ(well.states[0].stability.stability, Stability::stable);
  const Equilibria hill = beside_a_drifting_coordinate("k*y^3/3 + k*y^2/2");
  ASSERT_EQ(hill.states.size(), 2U);
  EXPECT_EQ(hill.states[0].stability.stability, Stability::unstable);
  EXPECT_EQ(hill.states[1].stability.stability, Stability::stable);
}

TEST(AllEquilibria, FreeFallHasNoneAndSaysSo) {
  const Equilibria found = equilibria_of("spring_pendulum", {{"k", 0}});
  EXPECT_TRUE(found.states.empty());
  EXPECT_TRUE(found.complete);
  EXPECT_FALSE(found.reason.empty());
}

TEST(AllEquilibria, NearACoordinateSingularityAreFoundOrTheSearchSaysItIsNotComplete) {
  const Equilibria slow = equilibria_of("free_spin_pendulum", {{"psi_dot", 1e-3}});
  EXPECT_TRUE(slow.complete);
  EXPECT_EQ(slow.states.size(), 4U);
  const Equilibria slower = equilibria_of("free_spin_pendulum", {{"psi_dot", 1e-9}});
  EXPECT_TRUE(slower.states.size() == 4 || !slower.complete);
  const Equilibria still = equilibria_of("free_spin_pendulum", {{"psi_dot", 0}});
  EXPECT_TRUE(still.complete);
  EXPECT_EQ(places(still), (std::vector<double>{0, pi}));
}

TEST(AllEquilibria, TimeInTheEquationsLeavesNone) {
  try {
    (void)equilibria_of("rolling_disk_platform", {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::not_applicable);
  }
}

TEST(SignsOfEigenvalues, AreCountedFromIntervals) {
  const auto of = [](std::vector<Interval> m, std::size_t n) {
    const Inertia inertia = inertia_of(std::move(m), n);
    return std::array{inertia.positive, inertia.negative, inertia.undecided};
  };
  EXPECT_EQ(of({2, 1, 1, 2}, 2), (std::array<std::size_t, 3>{2, 0, 0}));
  EXPECT_EQ(of({1, 2, 2, 1}, 2), (std::array<std::size_t, 3>{1, 1, 0}));
  EXPECT_EQ(of({0, 1, 1, 0}, 2), (std::array<std::size_t, 3>{1, 1, 0}));
  EXPECT_EQ(of({1, 1, 1, 1}, 2), (std::array<std::size_t, 3>{1, 0, 1}));
  EXPECT_EQ(of({-1, 0, 0, Interval(-1e-9, 1e-9)}, 2), (std::array<std::size_t, 3>{0, 1, 1}));
  EXPECT_EQ(of({1e-12, 0, 0, 1e12}, 2), (std::array<std::size_t, 3>{2, 0, 0}));
}

}  // namespace
}  // namespace qdot
