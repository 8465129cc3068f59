// Periodic gaits: the walker's against reference values, and what must hold for any.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/gait/gait.hpp"
#include "core/gait/gait_search.hpp"
#include "tests/support/files.hpp"
#include "tests/support/random.hpp"
#include "tests/support/scenes.hpp"

namespace qdot {
namespace {

const Dynamics& walker() {
  static const Dynamics dynamics(test::model_of("compass_walker"));
  return dynamics;
}

std::vector<double> parameters(const Values& given) { return parameter_values(walker().model(), given); }
Gaits gaits_with(const Values& given) { return periodic_gaits(walker(), parameters(given)); }

/// The number is within its error of the reference, and the error is small.
void expect_known(const Uncertain& number, double expected, double most, const char* what) {
  EXPECT_NEAR(number.value, expected, number.error + 4e-16 * std::abs(expected)) << what;
  EXPECT_LT(number.error, most) << what;
}

TEST(Gait, AgreesWithTheReferenceWithinItsErrors) {
  const api::Json reference = test::json_file("tests/reference/compass_walker.json");
  int cases = 0;
  for (const api::Json& entry : reference["cases"]) {
    if (entry["quantity"] != "gait") continue;
    const Gaits found = gaits_with(entry["parameters"].get<Values>());
    ASSERT_EQ(found.gaits.size(), 2u);
    const api::Json& expected = entry["expected"];
    const bool is_long = expected["gait"] == "long";
    const Gait& gait = found.gaits[is_long ? 1 : 0];
    EXPECT_EQ(gait.kind, is_long ? Gait::Kind::long_step : Gait::Kind::short_step);
    const char* names[] = {"theta", "phi", "theta_dot", "phi_dot"};
    for (std::size_t i = 0; i < 4; ++i) {
      expect_known(gait.state[i], expected[names[i]], 1e-12, names[i]);
      expect_known(gait.pre_impact[i], expected["pre_impact"][names[i]], 1e-11, names[i]);
    }
    expect_known(gait.step_time, expected["step_time"], 2e-12, "step_time");
    expect_known(*gait.step_length, 2 * std::sin(expected["theta"].get<double>()), 1e-11, "step_length");
    ASSERT_EQ(gait.multipliers.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      const std::complex<double> multiplier(expected["multipliers"][i]["re"],
                                            expected["multipliers"][i]["im"]);
      EXPECT_LT(std::abs(gait.multipliers[i] - multiplier), gait.multiplier_errors[i] + 1e-15);
      EXPECT_LT(gait.multiplier_errors[i], 1e-9);
    }
    EXPECT_EQ(gait.stability == GaitStability::stable, expected["stable"].get<bool>());
    EXPECT_LT(gait.residual, 1e-13);
    ++cases;
  }
  EXPECT_EQ(cases, 2);
}

TEST(Gait, OfMassiveFeetIsTheOneKnownForAHundredth) {
  const Gaits found = gaits_with({{"m", 0.01}, {"g", 1}, {"gamma", 0.009}});
  ASSERT_EQ(found.gaits.size(), 2u);
  EXPECT_NEAR(found.gaits[1].state[0].value, 0.198825, 1e-6);
  EXPECT_NEAR(found.gaits[1].multipliers[0].real(), -0.2553, 1e-4);
  EXPECT_NEAR(found.gaits[1].multipliers[0].imag(), 0.4078, 1e-4);
}

/// Central differences of the section map, followed to its event: their own error is of order 1e-8.
TEST(Gait, HasTheMultipliersOfTheSectionMapsDifferences) {
  test::Random random(9);
  int compared = 0;
  for (int i = 0; i < 8; ++i) {
    const auto given =
        parameters({{"m", random.real(0, 0.4)}, {"gamma", random.real(0.002, 0.05)}, {"g", 1}});
    SectionMap map(walker());
    map.set_parameters(given);
    for (const Recurrence& candidate : search_gaits(map, [](const Recurrence&) { return true; }).candidates) {
      const auto gait = polished(map, candidate);
      if (!gait) continue;
      Eigen::MatrixXd differences(map.size(), map.size());
      bool complete = true;
      for (Eigen::Index j = 0; j < map.size(); ++j) {
        const double h = 1e-5 * gait->at.u.norm();
        Eigen::VectorXd ahead = gait->at.u, behind = gait->at.u;
        ahead[j] += h;
        behind[j] -= h;
        const auto a = map.stride(ahead, 1e-14), b = map.stride(behind, 1e-14);
        complete = complete && a && b;
        if (complete) differences.col(j) = (map.section(a->before) - map.section(b->before)) / (2 * h);
      }
      if (!complete) continue;
      EXPECT_LT((differences - gait->section).norm(), 1e-5 * gait->section.norm());
      ++compared;
    }
  }
  EXPECT_GE(compared, 12);
}

TEST(Gait, HasTheSameShapeWithAnyMassLengthAndGravity) {
  test::Random random(10);
  for (int i = 0; i < 4; ++i) {
    const double mu = random.real(0, 0.3), gamma = random.real(0.003, 0.04);
    const double M = random.real(0.1, 50), l = random.real(0.1, 3), g = random.real(0.1, 30);
    const Gaits unit = gaits_with({{"m", mu}, {"gamma", gamma}, {"g", 1}});
    const Gaits other = gaits_with({{"M", M}, {"m", mu * M}, {"l", l}, {"g", g}, {"gamma", gamma}});
    ASSERT_EQ(unit.gaits.size(), other.gaits.size());
    EXPECT_FALSE(unit.gaits.empty());
    const double time = std::sqrt(l / g);
    for (std::size_t k = 0; k < unit.gaits.size(); ++k) {
      EXPECT_NEAR(other.gaits[k].state[0].value, unit.gaits[k].state[0].value, 1e-11);
      EXPECT_NEAR(other.gaits[k].state[2].value * time, unit.gaits[k].state[2].value, 1e-11);
      EXPECT_NEAR(other.gaits[k].step_time.value / time, unit.gaits[k].step_time.value, 1e-11);
      EXPECT_NEAR(other.gaits[k].step_length->value / l, unit.gaits[k].step_length->value, 1e-10);
      EXPECT_LT(std::abs(other.gaits[k].multipliers[0] - unit.gaits[k].multipliers[0]), 1e-7);
    }
  }
}

/// The state's derivative by mu is of order -0.15 at 0.
TEST(Gait, TendsToThatOfMasslessFeet) {
  const Gait massless = gaits_with({{"g", 1}}).gaits.at(1);
  for (const double mu : {1e-4, 1e-8, 1e-12, 1e-300}) {
    const Gait gait = gaits_with({{"m", mu}, {"g", 1}}).gaits.at(1);
    EXPECT_NEAR(gait.state[0].value, massless.state[0].value, mu + 1e-12) << mu;
    EXPECT_LT(std::abs(gait.multipliers[0] - massless.multipliers[0]), 100 * mu + 1e-9) << mu;
  }
}

/// theta* is of order gamma^(1/3); the ratio of velocity and angle is that of Garcia et al. (1998), sections
/// 6 and 7: coth(T/2), T = pi for the short gait and tan(T/2) = -3 tanh(T/2) for the long one.
TEST(Gait, ShrinksWithTheSlopeAsItsExpansionSays) {
  for (const double gamma : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1}) {
    const Gaits found = gaits_with({{"gamma", gamma}, {"g", 1}});
    ASSERT_EQ(found.gaits.size(), 2u) << gamma;
    EXPECT_NEAR(found.gaits[0].step_time.value, std::acos(-1), 4 * std::pow(gamma, 2. / 3)) << gamma;
    EXPECT_NEAR(found.gaits[1].step_time.value, 3.812, 4 * std::pow(gamma, 2. / 3) + 1e-3) << gamma;
    EXPECT_NEAR(found.gaits[1].state[0].value / std::cbrt(gamma), 0.970956, std::cbrt(gamma)) << gamma;
  }
}

TEST(Gait, NeedsASlopeAndGravity) {
  EXPECT_TRUE(gaits_with({{"gamma", 0}}).gaits.empty());
  EXPECT_NE(gaits_with({{"gamma", 0}}).reason.find("rest"), std::string::npos);
  for (const Values& given : {Values{{"gamma", -0.01}}, Values{{"gamma", -1e-6}}, Values{{"g", 0}}}) {
    const Gaits found = gaits_with(given);
    EXPECT_TRUE(found.gaits.empty());
    EXPECT_FALSE(found.reason.empty());
  }
}

TEST(Gait, IsNoQuestionWhereNothingCollides) {
  const Dynamics pendulum(test::model_of("cart_pendulum"));
  try {
    SectionMap map(pendulum);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::not_applicable);
  }
}

TEST(SectionMap, EndsAtTheHeelStrikeAndNotWhereTheFootScuffs) {
  SectionMap map(walker());
  map.set_parameters(parameters({{"g", 1}}));
  Eigen::VectorXd u(2);
  u << -0.2, -0.216;
  const auto stride = map.stride(u, 1e-12);
  ASSERT_TRUE(stride);
  EXPECT_LT(stride->before[0], 0);
  EXPECT_NEAR(stride->before[1], 2 * stride->before[0], 1e-12);
  EXPECT_GT(stride->duration, 3);
  EXPECT_EQ(stride->ignored_crossings, 0);
}

TEST(SectionMap, TellsAFall) {
  SectionMap map(walker());
  map.set_parameters(parameters({{"g", 1}}));
  Eigen::VectorXd u(2);
  for (const double speed : {-0.01, -2.0}) {
    u << -0.2, speed;
    EXPECT_FALSE(map.stride(u, 1e-9)) << speed;
  }
}

/// theta and theta_dot before a heel strike decide the state after it.
TEST(SectionMap, HasAsManyDimensionsAsTheImpactLeaves) {
  SectionMap map(walker());
  map.set_parameters(parameters({{"m", 0.1}, {"g", 1}}));
  Eigen::VectorXd u(2);
  u << -0.19, -0.21;
  EXPECT_EQ(map.size(), 2);
  EXPECT_EQ(map.dimension(*map.flow(u, 3.5, 1e-9)), 2);
}

}  // namespace
}  // namespace qdot
