// Motions at the extremes: within their stated error, or refused with a reason.

#include "tests/calibration/extremes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/calibration/verdict.hpp"
#include "tests/support/motions.hpp"

namespace qdot::test {
namespace {

constexpr std::uint64_t steps_of_a_test = 1000;  ///< of the reference; longer ones are in the report alone

TEST(Extremes, AreWithinTheirStatedErrorOrRefused) {
  int held = 0;
  for (const Extreme& extreme : extremes()) {
    if (extreme.reference_steps == 0 || extreme.reference_steps > steps_of_a_test) continue;
    const Outcome outcome = outcome_of(extreme.asked, extreme.reference_steps);
    const std::string what = extreme.group + ": " + extreme.name;
    EXPECT_NE(fate(outcome), "NOT HELD") << what << '\n' << description(outcome);
    EXPECT_TRUE(!outcome.failed() || outcome.status() != "complete") << what;
    EXPECT_TRUE(outcome.measured.meets_request != false || !outcome.measured.reason.empty()) << what;
    held += fate(outcome) == "held";
  }
  EXPECT_GE(held, 40);
}

/// Rows of a motion whose units of mass, length and time are others.
std::vector<double> scaled_states(const Values& given, double length) {
  Asked asked = asked_for("spring_pendulum", given, 10, 101);
  asked.request.tolerances = {1e-14, 1e-17 * length};
  Simulation motion = simulate(Dynamics(model_of(asked.system)), asked.request);
  EXPECT_EQ(motion.rows, 101U);
  for (std::size_t i = 0; i < motion.states.size(); i += 2) motion.states[i] /= length;  // l and l'
  return motion.states;
}

TEST(Extremes, UnitsDoNotMatter) {
  const std::vector<double> plain = scaled_states({}, 1);
  for (const double s : {1e-150, 1e150}) {
    const std::vector<double> masses = scaled_states({{"m", 0.5 * s}, {"k", 40 * s}}, 1);
    const std::vector<double> lengths =
        scaled_states({{"l0", 0.37 * s}, {"g", 9.81 * s}, {"l", 0.55 * s}}, s);
    ASSERT_EQ(masses.size(), plain.size());
    ASSERT_EQ(lengths.size(), plain.size());
    for (std::size_t i = 0; i < plain.size(); ++i) {
      EXPECT_NEAR(masses[i], plain[i], 1e-12 * std::max(1.0, std::abs(plain[i]))) << s;
      EXPECT_NEAR(lengths[i], plain[i], 1e-12 * std::max(1.0, std::abs(plain[i]))) << s;
    }
  }
}

TEST(Extremes, AChaoticMotionsHorizonIsRight) {
  for (const Extreme& extreme : extremes()) {
    if (extreme.group != "Chaos") continue;
    const Outcome outcome = outcome_of(extreme.asked, extreme.reference_steps);
    ASSERT_EQ(outcome.true_horizon.has_value(), outcome.measured.horizon.has_value()) << extreme.name;
    if (!outcome.true_horizon) continue;
    EXPECT_NEAR(*outcome.measured.horizon, *outcome.true_horizon, 0.2 * *outcome.true_horizon)
        << extreme.name;
  }
}

}  // namespace
}  // namespace qdot::test
