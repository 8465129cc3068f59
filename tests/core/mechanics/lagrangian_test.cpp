// T, V, momenta and h derived from positions are those written on paper.

#include "core/mechanics/lagrangian.hpp"

#include "tests/support/agreement.hpp"
#include "tests/support/system_test.hpp"

namespace qdot::lagrangian_test {
namespace {

using test::agrees;
using test::mechanics_of;
using test::value_of;

class DerivedLagrangian : public test::SystemTest {};
INSTANTIATE_TEST_SUITE_P(Systems, DerivedLagrangian, testing::ValuesIn(test::all_systems()),
                         test::system_name);

class DerivedEnergies : public test::SystemTest {};
INSTANTIATE_TEST_SUITE_P(Systems, DerivedEnergies,
                         testing::ValuesIn(test::systems_where([](const auto& name) {
                           return test::scene_of(name).lagrangian.empty();
                         })),
                         test::system_name);

TEST_P(DerivedEnergies, AreTheOnesWrittenByHand) {
  each_state([&](const Values& state) {
    const test::Mechanics paper = mechanics_of(GetParam(), state);
    EXPECT_TRUE(agrees(value_of(*model().lagrangian.kinetic_energy, state), *paper.kinetic));
    EXPECT_TRUE(agrees(value_of(*model().lagrangian.potential_energy, state), *paper.potential));
    EXPECT_TRUE(
        agrees(value_of(model().lagrangian.lagrangian, state), *paper.kinetic + -1 * *paper.potential));
    EXPECT_TRUE(agrees(value_of(*model().energy, state), *paper.kinetic + *paper.potential));
  });
}

TEST_P(DerivedLagrangian, HasTheMomentaWrittenByHand) {
  each_state([&](const Values& state) {
    const test::Mechanics paper = mechanics_of(GetParam(), state);
    ASSERT_EQ(model().momenta.size(), paper.momenta.size());
    for (std::size_t i = 0; i < paper.momenta.size(); ++i)
      EXPECT_TRUE(agrees(value_of(model().momenta[i], state), paper.momenta[i])) << i;
  });
}

TEST_P(DerivedLagrangian, HasTheJacobiIntegralWrittenByHand) {
  each_state([&](const Values& state) {
    EXPECT_TRUE(agrees(value_of(model().jacobi, state), mechanics_of(GetParam(), state).jacobi));
  });
}

TEST_P(DerivedEnergies, ComeInThreeDegreesOfTheVelocities) {
  ASSERT_EQ(model().kinetic_parts.size(), 3u);
  constexpr double stretch = 3;
  each_state([&](const Values& state) {
    const Values at = state;
    Values faster = state;
    for (const Coordinate& q : model().scene.coordinates) faster[q.name + "_dot"] *= stretch;
    test::Terms whole;
    for (std::size_t i = 0; i < 3; ++i) {
      const double part = value_of(model().kinetic_parts[i], at);
      const double stretched = std::pow(stretch, 2.0 - static_cast<double>(i)) * part;
      EXPECT_NEAR(value_of(model().kinetic_parts[i], faster), stretched,
                  test::round_off * std::abs(stretched));
      whole = whole + test::Terms{part};
    }
    EXPECT_TRUE(agrees(value_of(*model().lagrangian.kinetic_energy, at), whole));
  });
}

class Reaction : public test::SystemTest {};
INSTANTIATE_TEST_SUITE_P(Systems, Reaction,
                         testing::Values("rolling_disk_platform", "rod_pendulum", "orbiting_pendulum"),
                         test::system_name);

TEST_P(Reaction, IsTheForceThatHoldsTheLength) {
  ASSERT_EQ(model().validity.size(), 1u);
  each_state([&](const Values& state) {
    EXPECT_TRUE(agrees(value_of(model().validity[0], state), *mechanics_of(GetParam(), state).reaction));
  });
}

TEST(Reaction, OfAForcedLengthBearsTheForceToo) {
  Scene scene = test::scene_of("orbiting_pendulum");
  scene.forces.push_back(
      {"pull", {"m*l*omega0^2*cos(omega0*t + phi)", "m*l*omega0^2*sin(omega0*t + phi)"}, {"bob", {}}});
  const auto pulled = build_model(scene);  // outwards along the string
  test::Random random(1);
  for (int i = 0; i < 20; ++i) {
    const Values state = test::random_state(*pulled, random);
    const double pull = state.at("m") * state.at("l") * std::pow(state.at("omega0"), 2);
    const test::Terms free = *mechanics_of("orbiting_pendulum", state).reaction;
    EXPECT_TRUE(agrees(value_of(pulled->validity[0], state), free + test::Terms{pull}));
  }
}

TEST(Lagrangian, CopiedLeavesTheOriginalGraphAsItWas) {
  const auto model = test::model_of("rod_pendulum");
  const std::size_t nodes = model->parsed.graph->size();
  const Lagrangian copy = copied(model->lagrangian);
  const Replacement no_gravity{copy.symbols.parameters[2], copy.graph->number(0)};
  const Lagrangian weightless = replaced(copy, {&no_gravity, 1});
  EXPECT_TRUE(weightless.potential_energy->is_zero());
  EXPECT_TRUE(copy.graph->symbol("a symbol of the copy").id() >= nodes);
  EXPECT_EQ(model->parsed.graph->size(), nodes);
}

TEST(Lagrangian, MomentumUnitIsActionOverTheCoordinatesUnit) {
  const Scene scene = test::scene_of("spring_pendulum");
  EXPECT_EQ(momentum_unit(scene, 0), "kg*m/s");
  EXPECT_EQ(momentum_unit(scene, 1), "kg*m^2/s");
}

}  // namespace
}  // namespace qdot::lagrangian_test
