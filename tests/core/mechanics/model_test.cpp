// Parameters and initial states: what a request gives, the rest by defaults that follow from it.

#include "core/mechanics/model.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "core/numerics/ball.hpp"
#include "tests/support/scenes.hpp"

namespace qdot {
namespace {

TEST(ParameterValues, FollowTheGivenOnesInTheirDefaults) {
  const auto model = test::model_of("cart_pendulum");  // M, m, k, l, g with M = 2 m, k = 2 m g/l
  const double g = 9.81;
  const auto are = [](std::vector<double> values) { return testing::Pointwise(testing::DoubleEq(), values); };
  const auto values = [&](const RealValues& given) {
    return std::vector<double>(parameter_values(*model, given));
  };
  EXPECT_THAT(values({}), are({1, 0.5, 2 * 0.5 * g / 0.4, 0.4, g}));
  EXPECT_THAT(values({{"m", 3}, {"l", 0.75}}), are({6, 3, 2 * 3 * g / 0.75, 0.75, g}));
  EXPECT_THAT(values({{"M", 7}, {"k", 0}}), are({7, 0.5, 0, 0.4, g}));
}

TEST(ParameterValues, AreTheDecimalsThemselves) {
  const auto model = test::model_of("cart_pendulum");
  const Reals values = parameter_values(*model, {{"l", Number::ratio(1, 3).rounded()}});
  const Ball g = Ball::literal(values.exact(4)), l = Ball::literal(values.exact(3));
  EXPECT_TRUE((g - Ball::literal(Number::ratio(981, 100).rounded())).contains_zero());
  EXPECT_TRUE((l * Ball(3) - Ball(1)).contains_zero());
  // k = 2 m g/l = 29.43
  const Ball k = Ball::literal(values.exact(2));
  EXPECT_TRUE((k - Ball::literal(Number::ratio(2943, 100).rounded())).contains_zero());
  EXPECT_LT(k.radius, 1e-28);
  EXPECT_FALSE((k - Ball(29.43)).contains_zero()) << "29.43 is no double";
}

TEST(InitialState, FollowsTheParametersInItsDefaults) {
  const auto model = test::model_of("free_spin_pendulum");  // m, l, g; psi_dot = 2 sqrt(g/l)
  const std::vector<double> parameters = parameter_values(*model, {{"l", 2.4525}});
  const std::vector<double> start = initial_state(*model, parameters, {{"theta", 0.25}});
  ASSERT_EQ(start.size(), 4u);
  EXPECT_EQ(start[0], 0.25);
  EXPECT_EQ(start[1], 0);
  EXPECT_EQ(start[2], 0);
  EXPECT_DOUBLE_EQ(start[3], 2 * std::sqrt(9.81 / 2.4525));
  EXPECT_EQ(initial_state(*model, parameters, {{"psi_dot", -1}})[3], -1);
}

TEST(Model, IsTheSameFromTheSameScene) {
  for (const std::string& name : test::practice_systems()) {
    const auto first = build_model(test::scene_of(name));
    const auto second = build_model(test::scene_of(name));
    ASSERT_EQ(first->parsed.graph->size(), second->parsed.graph->size()) << name;
    for (NodeId id = 0; id < first->parsed.graph->size(); ++id)
      ASSERT_EQ(first->parsed.graph->node(id), second->parsed.graph->node(id)) << name;
  }
}

}  // namespace
}  // namespace qdot
