// What is conserved, by the symmetries that a system has with and without some of its parameters.

#include "core/mechanics/conserved.hpp"

#include "tests/support/agreement.hpp"
#include "tests/support/system_test.hpp"

namespace qdot {
namespace {

using test::value_of;

struct Symmetries {
  std::string system;
  std::vector<std::string> zero;  ///< parameters and inputs that vanish
  std::vector<std::string> conserved;
};

void PrintTo(const Symmetries& s, std::ostream* out) { *out << s.system; }

const std::vector<Symmetries> table{
    {"spring_pendulum", {}, {"energy"}},
    {"spring_pendulum", {"g"}, {"energy", "p_theta"}},
    {"forced_spring_pendulum", {}, {}},
    {"forced_spring_pendulum", {"F"}, {"energy"}},
    {"rolling_disk_platform", {}, {}},
    {"rolling_disk_platform", {"g"}, {"h"}},
    {"rolling_disk_platform", {"Omega"}, {"energy", "p_q"}},
    {"cart_pendulum", {}, {"energy"}},
    {"cart_pendulum", {"k"}, {"energy", "p_x"}},
    {"rod_pendulum", {}, {"energy"}},
    {"rod_spring_pendulum", {}, {"energy"}},
    {"whirling_pendulum", {}, {"h"}},
    {"whirling_pendulum", {"Omega"}, {"energy"}},
    {"orbiting_pendulum", {}, {"h"}},
    {"orbiting_pendulum", {"r"}, {"h", "p_phi"}},
    {"orbiting_pendulum", {"omega0"}, {"energy", "p_phi"}},
    {"free_spin_pendulum", {}, {"energy", "p_psi"}},
    {"compass_walker", {}, {"energy"}},
    {"rotating_l_bar", {}, {"h"}},
    {"rotating_l_bar", {"Omega"}, {"energy"}},
    {"spherical_pendulum", {}, {"energy", "p_phi"}},
    {"kepler", {}, {"energy", "p_theta"}},
    {"driven_pivot", {}, {}},
    {"driven_pivot", {"a"}, {"energy"}},
    {"atwood", {}, {"energy"}},
    {"atwood", {"g"}, {"energy", "p_x"}},
    {"bead_on_hoop", {}, {"h"}},
    {"foucault", {}, {"h"}},
    {"triple_pendulum", {}, {"energy"}},
    {"damped_oscillator", {}, {}},
    {"damped_oscillator", {"F"}, {}},
    {"damped_oscillator", {"F", "b"}, {"energy"}},
    {"magnetic_particle", {}, {"h", "p_z"}},
};

class ConservedQuantities : public testing::TestWithParam<Symmetries> {
 protected:
  ConservedQuantities() {
    std::vector<Replacement> vanishing;
    Graph& graph = *lagrangian_.graph;
    for (const std::string& name : GetParam().zero)
      vanishing.emplace_back(graph.symbol(name), graph.number(0));
    lagrangian_ = replaced(lagrangian_, vanishing);
    quantities_ = conserved_quantities(lagrangian_, model_->scene);
  }

  const std::shared_ptr<const Model> model_{test::model_of(GetParam().system)};
  Lagrangian lagrangian_{copied(model_->lagrangian)};
  std::vector<ConservedQuantity> quantities_;
};

INSTANTIATE_TEST_SUITE_P(Table, ConservedQuantities, testing::ValuesIn(table), [](const auto& info) {
  std::string name = info.param.system;
  for (const std::string& zero : info.param.zero) name += "_without_" + zero;
  return name;
});

TEST_P(ConservedQuantities, AreNamed) {
  std::vector<std::string> names;
  for (const ConservedQuantity& quantity : quantities_) names.push_back(quantity.name);
  EXPECT_EQ(names, GetParam().conserved);
  for (const ConservedQuantity& quantity : quantities_) EXPECT_FALSE(quantity.why.empty());
}

/// dC/dt = sum of dC/dq q' + dC/dq' q'' + dC/dt along the equations of motion.
TEST_P(ConservedQuantities, DoNotChangeAlongTheMotion) {
  const Dynamics dynamics(model_);  // inputs by default: 0
  const Symbols& symbols = lagrangian_.symbols;
  test::Random random(5);
  for (int i = 0; i < test::identity_states; ++i) {
    Values state = test::random_state(*model_, random);
    for (const std::string& name : GetParam().zero) state[name] = 0;
    const std::vector<double> accelerations = test::outputs_of(dynamics.accelerations(), *model_, state);
    for (const ConservedQuantity& quantity : quantities_) {
      test::Terms rate{value_of(differentiate(quantity.value, symbols.t), state)};
      for (std::size_t k = 0; k < accelerations.size(); ++k) {
        const Expression& q = symbols.coordinates.value[k];
        const Expression& velocity = symbols.coordinates.rate[k];
        const double speed = value_of(velocity, state);
        rate =
            rate + test::Terms{value_of(differentiate(quantity.value, q), state) * speed,
                               value_of(differentiate(quantity.value, velocity), state) * accelerations[k]};
      }
      EXPECT_LE(std::abs(rate.value), test::round_off * rate.size) << quantity.name;
    }
  }
}

TEST(WhyEnergyChanges, NamesWhatDoesTheWork) {
  const auto why = [](const std::string& system) {
    return why_energy_changes(copied(test::model_of(system)->lagrangian));
  };
  EXPECT_EQ(why("spring_pendulum"), "");
  EXPECT_EQ(why("forced_spring_pendulum"), "Forces outside the Lagrangian do work.");
  EXPECT_EQ(why("damped_oscillator"), "Forces outside the Lagrangian do work.");
  EXPECT_EQ(why("driven_pivot"),
            "The Lagrangian contains the time explicitly: what moves the system from outside does work.");
  EXPECT_EQ(
      why("whirling_pendulum"),
      "T has terms that are not quadratic in the velocities: what keeps the prescribed motion does work, so "
      "h is constant and T + V is not.");
}

TEST(WhyEnergyChanges, IsTrueOfTheWhirlingPendulum) {
  const auto model = test::model_of("whirling_pendulum");
  Values state{{"m", 1},    {"l", 1},     {"R", 1},         {"Omega", 2},
               {"g", 9.81}, {"theta", 1}, {"theta_dot", 1}, {"t", 0}};
  const double energy = value_of(*model->energy, state);
  const double acceleration = test::outputs_of(Dynamics(model).accelerations(), *model, state)[0];
  constexpr double step = 1e-6;
  state["theta"] += step * state["theta_dot"];
  state["theta_dot"] += step * acceleration;
  EXPECT_GT(std::abs(value_of(*model->energy, state) - energy) / step, 0.1);  // watts, not round-off
}

}  // namespace
}  // namespace qdot
