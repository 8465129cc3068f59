// Ignorable coordinates leave Routh's function, their momenta stay.

#include "core/mechanics/reduction.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/dynamics/dynamics.hpp"
#include "tests/support/random.hpp"
#include "tests/support/scenes.hpp"

namespace qdot {
namespace {

double value_of(const Reduction& reduction, const Expression& e,
                const std::vector<std::pair<std::string, double>>& at) {
  std::vector<Assignment> values;
  for (const auto& [name, value] : at) values.emplace_back(reduction.graph->symbol(name), value);
  return evaluate(e, values);
}

TEST(Reduction, OfThePendulumOnASpinningArmIsRouthsFunction) {
  const Reduction reduction = derive_reduction(test::model_of("free_spin_pendulum")->lagrangian);
  EXPECT_EQ(reduction.kept, (std::vector<std::size_t>{0}));
  EXPECT_EQ(reduction.ignored, (std::vector<std::size_t>{1}));
  EXPECT_TRUE(reduction.autonomous);
  EXPECT_TRUE(reduction.conservative);
  test::Random random(1);
  for (int i = 0; i < 20; ++i) {
    const double m = random.real(0.2, 2), l = random.real(0.2, 2), g = random.real(0, 20);
    const double theta = random.real(-0.4, 3), rate = random.real(-3, 3), beta = random.real(-2, 2);
    const std::vector<std::pair<std::string, double>> at{
        {"m", m}, {"l", l}, {"g", g}, {"theta", theta}, {"theta_dot", rate}, {"p_psi", beta}};
    const double a = 0.5 + std::sin(theta);
    const double expected =
        m * l * l * rate * rate / 2 - beta * beta / (2 * m * l * l * a * a) + m * g * l * std::cos(theta);
    EXPECT_NEAR(value_of(reduction, reduction.routhian, at), expected, 1e-12 * (1 + std::abs(expected)));
    const double spin = beta / (m * l * l * a * a);
    EXPECT_NEAR(value_of(reduction, reduction.ignored_rates[0], at), spin, 1e-12 * (1 + std::abs(spin)));
  }
}

TEST(Reduction, ASpringWithoutStiffnessMakesTheCartIgnorable) {
  const auto model = test::model_of("cart_pendulum");
  const Dynamics dynamics(model);
  const auto with = dynamics.statics(parameter_values(*model, {{"k", 10}}));
  EXPECT_TRUE(with->reduction.ignored.empty());
  EXPECT_EQ(with->reduction.degrees_of_freedom(), 2U);
  const auto without = dynamics.statics(parameter_values(*model, {{"k", 0}}));
  EXPECT_EQ(without->reduction.ignored, (std::vector<std::size_t>{0}));
  EXPECT_EQ(without->reduction.kept, (std::vector<std::size_t>{1}));
}

TEST(Reduction, NothingIsIgnorableInASpringPendulumUnderGravity) {
  const Reduction reduction = derive_reduction(test::model_of("spring_pendulum")->lagrangian);
  EXPECT_TRUE(reduction.ignored.empty());
  EXPECT_EQ(reduction.x.size(), 2U);
  EXPECT_EQ(reduction.constants.size(), 4U);
}

TEST(Reduction, TimeInAForceIsSeen) {
  EXPECT_FALSE(derive_reduction(test::model_of("rolling_disk_platform")->lagrangian).autonomous);
}

}  // namespace
}  // namespace qdot
