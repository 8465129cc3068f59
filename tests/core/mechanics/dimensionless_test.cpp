// Which combinations of its parameters matter to a system.

#include "core/mechanics/dimensionless.hpp"

#include <array>

#include "core/expr/print/print.hpp"
#include "core/mechanics/dimension_check.hpp"
#include "core/mechanics/notation.hpp"
#include "tests/support/agreement.hpp"
#include "tests/support/system_test.hpp"

namespace qdot::dimensionless_test {
namespace {

using test::value_of;

struct Groups {
  std::string system;
  std::vector<std::string> groups;  ///< "name = value"
  std::string energy, time;         ///< units
};

void PrintTo(const Groups& g, std::ostream* out) { *out << g.system; }

const std::vector<Groups> table{
    {"spring_pendulum", {"l0_hat = k*l0/(m*g)"}, "m^2*g^2/k", "sqrt(m)/sqrt(k)"},
    {"rolling_disk_platform", {"Omega_hat = sqrt(r)*Omega/sqrt(g)"}, "m*r*g", "sqrt(r)/sqrt(g)"},
    {"cart_pendulum", {"M_hat = M/m", "k_hat = k*l/(m*g)"}, "m*l*g", "sqrt(l)/sqrt(g)"},
    {"rod_pendulum", {}, "m*l*g", "sqrt(l)/sqrt(g)"},
    {"rod_spring_pendulum", {"k_hat = l*k/(m*g)", "l0_hat = l0/l"}, "m*l*g", "sqrt(l)/sqrt(g)"},
    {"whirling_pendulum", {"R_hat = R/l", "Omega_hat = sqrt(l)*Omega/sqrt(g)"}, "m*l*g", "sqrt(l)/sqrt(g)"},
    {"orbiting_pendulum", {"r_hat = r/l"}, "m*l^2*omega0^2", "1/omega0"},
    {"free_spin_pendulum", {}, "m*l*g", "sqrt(l)/sqrt(g)"},
    {"compass_walker", {"mu = m/M", "gamma = gamma"}, "M*l*g", "sqrt(l)/sqrt(g)"},
    {"rotating_l_bar", {"Omega_hat = sqrt(l)*Omega/sqrt(g)"}, "m*l*g", "sqrt(l)/sqrt(g)"},
    {"driven_pivot",
     {"a_hat = a/l", "g_hat = g/(l*w^2)"},
     "m*l^2*w^2",
     "1/w"},  // without scales: the first that fit
};

class DimensionlessSystem : public testing::TestWithParam<Groups> {
 protected:
  const std::shared_ptr<const Model> model_{build_model(test::scene_of(GetParam().system))};
  const std::optional<DimensionlessForm> form_{
      dimensionless_form(model_->scene, model_->parsed, model_->lagrangian)};
};

INSTANTIATE_TEST_SUITE_P(Table, DimensionlessSystem, testing::ValuesIn(table),
                         [](const auto& info) { return info.param.system; });

TEST_P(DimensionlessSystem, HasTheseGroupsAndUnits) {
  ASSERT_TRUE(form_.has_value());
  const auto text = [&](const Expression& e) { return print(e, Form::text, notation_of(model_->scene)); };
  std::vector<std::string> groups;
  for (const DimensionlessGroup& group : form_->groups)
    groups.push_back(group.name + " = " + text(group.value));
  EXPECT_EQ(groups, GetParam().groups);
  EXPECT_EQ(text(form_->energy_unit), GetParam().energy);
  EXPECT_EQ(text(form_->time_unit), GetParam().time);
}

TEST_P(DimensionlessSystem, HasALagrangianOfTheGroupsAlone) {
  std::vector<Expression> known{model_->parsed.symbols.t};
  Graph& graph = *model_->parsed.graph;
  for (const DimensionlessGroup& group : form_->groups) known.push_back(graph.symbol(group.name));
  for (const auto* symbols :
       {&model_->parsed.symbols.coordinates.value, &model_->parsed.symbols.coordinates.rate})
    known.insert(known.end(), symbols->begin(), symbols->end());
  const std::array root{form_->lagrangian.id()};
  for (const NodeId id : reachable(graph, root)) {
    if (!std::holds_alternative<Symbol>(graph.node(id))) continue;
    EXPECT_NE(std::find(known.begin(), known.end(), Expression(graph, id)), known.end())
        << std::get<Symbol>(graph.node(id)).name;
  }
}

TEST_P(DimensionlessSystem, HasTheSameLagrangianWhereTheUnitsAreOne) {
  test::Random random(6);
  for (int i = 0; i < test::identity_states; ++i) {
    Values state = test::random_state(*model_, random);
    for (const Expression& unit : form_->units) state[std::get<Symbol>(unit.node()).name] = 1;
    for (const DimensionlessGroup& group : form_->groups) state[group.name] = value_of(group.value, state);
    const test::Mechanics paper = test::mechanics_of(GetParam().system, state);
    EXPECT_TRUE(test::agrees(value_of(form_->lagrangian, state), *paper.kinetic + -1 * *paper.potential));
  }
}

TEST(DimensionlessForm, OfAngularSystemsScalesLByItsUnits) {
  const auto model = build_model(test::scene_of("compass_walker"));
  const auto form = dimensionless_form(model->scene, model->parsed, model->lagrangian);
  test::Random random(7);
  for (int i = 0; i < test::identity_states; ++i) {
    Values state = test::random_state(*model, random);
    const test::Mechanics paper = test::mechanics_of("compass_walker", state);
    const double energy = value_of(form->energy_unit, state);
    const double time = value_of(form->time_unit, state);
    for (const DimensionlessGroup& group : form->groups) state[group.name] = value_of(group.value, state);
    for (const char* rate : {"theta_dot", "phi_dot"}) state[rate] *= time;
    EXPECT_TRUE(
        test::agrees(energy * value_of(form->lagrangian, state), *paper.kinetic + -1 * *paper.potential));
  }
}

TEST(DimensionlessForm, IsNotGivenWhereTheParametersSpanNoTime) {
  Scene scene = test::scene_of("damped_oscillator");
  scene.parameters.resize(1);
  scene.springs.clear();
  scene.dissipation.clear();
  const auto model = build_model(scene);  // a mass alone
  EXPECT_FALSE(dimensionless_form(model->scene, model->parsed, model->lagrangian).has_value());
}

}  // namespace
}  // namespace qdot::dimensionless_test
