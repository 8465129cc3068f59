// Hamilton's and Routh's functions say the same as the Lagrangian.

#include "core/mechanics/canonical.hpp"

#include "core/expr/print/print.hpp"
#include "core/mechanics/notation.hpp"
#include "tests/support/agreement.hpp"
#include "tests/support/system_test.hpp"

namespace qdot {
namespace {

using test::value_of;

/// The inverse of M magnifies round-off by M's condition number: at a thousand seeded states at most 1e4.
constexpr double inverted = 1e-10;

/// The state with p_i for its velocities.
Values with_momenta(const Model& model, Values state) {
  for (std::size_t i = 0; i < model.degrees_of_freedom(); ++i)
    state["p_" + model.scene.coordinates[i].name] = value_of(model.momenta[i], state);
  return state;
}

class Hamiltonian : public test::SystemTest {
 protected:
  Lagrangian lagrangian_{copied(model().lagrangian)};
  std::optional<Expression> hamiltonian_{hamiltonian(lagrangian_)};
};
INSTANTIATE_TEST_SUITE_P(Systems, Hamiltonian, testing::ValuesIn(test::all_systems()), test::system_name);

TEST_P(Hamiltonian, ContainsNoVelocity) {
  ASSERT_TRUE(hamiltonian_.has_value());
  EXPECT_FALSE(depends_on(*hamiltonian_, lagrangian_.symbols.coordinates.rate));
}

TEST_P(Hamiltonian, IsTheJacobiIntegralInTheMomenta) {
  each_state([&](const Values& state) {
    const test::Terms h = test::mechanics_of(GetParam(), state).jacobi;
    EXPECT_TRUE(test::agrees(value_of(*hamiltonian_, with_momenta(model(), state)), h, inverted));
  });
}

/// q_i' = dH/dp_i, and dH/dq_i = -dL/dq_i at corresponding states.
TEST_P(Hamiltonian, GivesHamiltonsEquations) {
  const std::vector<Expression> momenta = momentum_symbols(lagrangian_);
  const Symbols::Varying& q = lagrangian_.symbols.coordinates;
  for (std::size_t i = 0; i < momenta.size(); ++i) {
    const Expression velocity = differentiate(*hamiltonian_, momenta[i]);
    const Expression force = differentiate(*hamiltonian_, q.value[i]);
    const Expression lagrange = differentiate(lagrangian_.lagrangian, q.value[i]);
    each_state([&](const Values& state) {
      const Values canonical = with_momenta(model(), state);
      const double speed = value_of(q.rate[i], state);
      const double size = test::mechanics_of(GetParam(), state).jacobi.size;  // of order one, as all symbols
      EXPECT_NEAR(value_of(velocity, canonical), speed, inverted * (1 + size));
      EXPECT_NEAR(value_of(force, canonical), -value_of(lagrange, state), inverted * (1 + size));
    });
  }
}

TEST(Hamiltonian, IsNotGivenWhereLIsNotQuadraticInTheVelocities) {
  Scene scene = test::scene_of("magnetic_particle");
  scene.lagrangian = "m*(x_dot^2 + y_dot^2 + z_dot^2)/2*(1 + x_dot^2/(x_dot^2 + y_dot^2))";
  const auto model = build_model(scene);
  EXPECT_FALSE(hamiltonian(copied(model->lagrangian)).has_value());
}

/// Goldstein, Classical Mechanics, exercise 2.21: of what the rails' turning gives T, m l^2 w^2/2 cancels.
TEST(Hamiltonian, OfACarriageOnTurningRailsHasNoTermsThatCancel) {
  Scene scene;
  scene.name = "carriage on turning rails";
  scene.parameters = {{"m", "kg", "1", {}, "", ""},
                      {"k", "N/m", "5", {}, "", ""},
                      {"l", "m", "1", {}, "", ""},
                      {"w", "rad/s", "1", {}, "", ""}};
  scene.coordinates = {{"r", "m", "0.1", "0", "", {}, "", ""}};
  scene.points = {{"p", {"l*cos(w*t) - r*sin(w*t)", "l*sin(w*t) + r*cos(w*t)"}}};
  scene.bodies = {Particle{"p", "m", {"p", {}}}};
  scene.potential = "k*r^2/2";
  const auto model = build_model(scene);
  EXPECT_EQ(print(*hamiltonian(copied(model->lagrangian)), Form::text, notation_of(model->scene)),
            "p_r*(p_r/(2*m) - l*w) + 1/2*(k - m*w^2)*r^2");
}

/// Two masses on a rod: 2 + M/m + m/M over m + M is (m + M)/(m M), which the terms without p_th do not share.
TEST(Hamiltonian, PartsThatHaveAFactorOfTheirOwnAreShort) {
  Scene scene;
  scene.name = "dumbbell";
  scene.parameters = {
      {"m", "kg", "1", {}, "", ""}, {"M", "kg", "2", {}, "", ""}, {"l", "m", "0.7", {}, "", ""}};
  scene.coordinates = {{"x", "m", "0", "0", "", {}, "", ""},
                       {"y", "m", "0", "0", "", {}, "", ""},
                       {"th", "rad", "0.3", "0", "", {}, "", ""}};
  scene.points = {{"p", {"x", "y"}}, {"q", {"x + l*cos(th)", "y + l*sin(th)"}}};
  scene.bodies = {Particle{"p", "m", {"p", {}}}, Particle{"q", "M", {"q", {}}}};
  const auto model = build_model(scene);
  EXPECT_EQ(
      print(*hamiltonian(copied(model->lagrangian)), Form::text, notation_of(model->scene)),
      "(1/(2*m) + 1/(2*M))*p_th^2/l^2 + (p_x^2 + p_y^2 + M*(p_y*cos(th) - p_x*sin(th))^2/m)/(2*(m + M)) "
      "+ p_th*(p_x*sin(th) - p_y*cos(th))/(m*l)");
}

TEST(Hamiltonian, HasThePotentialAsItIsWritten) {
  const auto model = test::model_of("spring_pendulum");
  EXPECT_EQ(print(*hamiltonian(copied(model->lagrangian)), Form::text, notation_of(model->scene)),
            "(p_l^2 + p_theta^2/l^2)/(2*m) + 1/2*k*(l - l0)^2 - m*g*l*cos(theta)");
}

class RouthsFunction : public test::SystemTest {};
INSTANTIATE_TEST_SUITE_P(Systems, RouthsFunction,
                         testing::Values("free_spin_pendulum", "spherical_pendulum", "kepler",
                                         "magnetic_particle"),
                         test::system_name);

TEST_P(RouthsFunction, IsTheLagrangianLessTheIgnoredMotion) {
  const Lagrangian lagrangian = copied(model().lagrangian);
  const auto reduced = routhian(lagrangian);
  ASSERT_TRUE(reduced.has_value());
  ASSERT_EQ(reduced->ignored.size(), 1u);
  const std::string ignored = model().scene.coordinates[reduced->ignored[0]].name;
  each_state([&](const Values& state) {
    const Values canonical = with_momenta(model(), state);
    const double rate = state.at(ignored + "_dot");
    const test::Terms expected{value_of(lagrangian.lagrangian, state), -canonical.at("p_" + ignored) * rate};
    EXPECT_NEAR(value_of(reduced->rates[0], canonical), rate, inverted * (1 + std::abs(rate)));
    EXPECT_TRUE(test::agrees(value_of(reduced->routhian, canonical), expected, inverted));
  });
}

TEST(RouthsFunction, OfProblem8IsTheSheets) {
  const auto model = test::model_of("free_spin_pendulum");
  const Lagrangian lagrangian = copied(model->lagrangian);
  const Notation notation = notation_of(model->scene);
  const auto reduced = routhian(lagrangian);
  EXPECT_EQ(print(reduced->routhian, Form::text, notation),  // (54)
            "1/2*m*l^2*theta_dot^2 - p_psi^2/(2*m*l^2*(1/2 + sin(theta))^2) + m*l*g*cos(theta)");
  EXPECT_EQ(print(reduced->rates[0], Form::text, notation),  // (53)
            "p_psi/(m*l^2*(1/2 + sin(theta))^2)");
}

TEST(RouthsFunction, IsNotGivenWhereNothingOrEverythingIsIgnorable) {
  EXPECT_FALSE(routhian(copied(test::model_of("compass_walker")->lagrangian)).has_value());
  const Lagrangian orbiting = copied(test::model_of("orbiting_pendulum")->lagrangian);
  const Replacement at_rest{orbiting.graph->symbol("omega0"), orbiting.graph->number(0)};
  const Lagrangian free = replaced(orbiting, {&at_rest, 1});
  EXPECT_EQ(ignorable_coordinates(free), std::vector<std::size_t>{0});
  EXPECT_FALSE(routhian(free).has_value());
}

}  // namespace
}  // namespace qdot
