// Derived equations of motion are those written on paper, and so are the accelerations that follow from them.

#include "core/mechanics/equations_of_motion.hpp"

#include "tests/support/agreement.hpp"
#include "tests/support/system_test.hpp"

namespace qdot {
namespace {

using test::agrees;
using test::mechanics_of;
using test::value_of;

/// Values of an expression matrix.
std::vector<std::vector<double>> values_of(const Matrix& matrix, const Values& state) {
  std::vector<std::vector<double>> values;
  for (const auto& row : matrix) {
    values.emplace_back();
    for (const Expression& entry : row) values.back().push_back(value_of(entry, state));
  }
  return values;
}

/// Pivots of Gauss's elimination; all positive exactly when a symmetric matrix is positive definite.
std::vector<double> pivots(std::vector<std::vector<double>> m) {
  std::vector<double> found;
  for (std::size_t k = 0; k < m.size(); ++k) {
    found.push_back(m[k][k]);
    for (std::size_t i = k + 1; i < m.size(); ++i) {
      const double factor = m[i][k] / m[k][k];
      for (std::size_t j = k; j < m.size(); ++j) m[i][j] -= factor * m[k][j];
    }
  }
  return found;
}

class DerivedEquations : public test::SystemTest {};
INSTANTIATE_TEST_SUITE_P(Systems, DerivedEquations, testing::ValuesIn(test::all_systems()),
                         test::system_name);

TEST_P(DerivedEquations, AreTheOnesWrittenByHand) {
  each_state([&](const Values& state) {
    const test::Mechanics paper = mechanics_of(GetParam(), state);
    ASSERT_EQ(model().equations.equations.size(), paper.equations.size());
    for (std::size_t i = 0; i < paper.equations.size(); ++i) {
      const Equation& equation = model().equations.equations[i];
      const double derived = value_of(equation.left, state) - value_of(equation.right, state);
      EXPECT_TRUE(agrees(value_of(equation.divided_by, state) * derived, paper.equations[i])) << i;
    }
  });
}

TEST_P(DerivedEquations, SayTheSameAsMassMatrixAndForcing) {
  each_state([&](const Values& state) {
    const EquationsOfMotion& derived = model().equations;
    const auto mass = values_of(derived.mass_matrix, state);
    const test::Mechanics paper = mechanics_of(GetParam(), state);
    for (std::size_t i = 0; i < mass.size(); ++i) {
      double residual = -value_of(derived.forcing[i], state);
      for (std::size_t j = 0; j < mass.size(); ++j)
        residual += mass[i][j] * state.at(model().scene.coordinates[j].name + "_ddot");
      EXPECT_TRUE(agrees(value_of(derived.equations[i].divided_by, state) * residual, paper.equations[i]));
    }
  });
}

/// The triple pendulum is on paper in its implicit form only.
class SolvedEquations : public test::SystemTest {};
INSTANTIATE_TEST_SUITE_P(Systems, SolvedEquations,
                         testing::ValuesIn(test::systems_where([](const auto& name) {
                           return name != "triple_pendulum";
                         })),
                         test::system_name);

TEST_P(SolvedEquations, ByCramersRuleGiveTheAccelerationsWrittenByHand) {
  const Lagrangian copy = copied(model().lagrangian);
  const std::vector<Expression> accelerations = solved(augmented(derive_equations(copy), copy));
  each_state([&](const Values& state) {
    const test::Mechanics paper = mechanics_of(GetParam(), state);
    ASSERT_EQ(accelerations.size(), paper.accelerations.size());
    for (std::size_t i = 0; i < accelerations.size(); ++i)
      EXPECT_TRUE(agrees(value_of(accelerations[i], state), paper.accelerations[i])) << i;
  });
}

TEST_P(SolvedEquations, CompiledGiveTheAccelerationsWrittenByHand) {
  const bool forced = !model().scene.inputs.empty();
  const Dynamics dynamics(test::model_of(GetParam()),
                          forced ? std::vector<std::string>{"m*cos(3*t)"} : std::vector<std::string>{});
  each_state([&](Values state) {
    if (forced) state["F"] = state.at("m") * std::cos(3 * state.at("t"));
    const test::Mechanics paper = mechanics_of(GetParam(), state);
    const std::vector<double> accelerations = test::outputs_of(dynamics.accelerations(), model(), state);
    for (std::size_t i = 0; i < accelerations.size(); ++i)
      EXPECT_TRUE(agrees(accelerations[i], paper.accelerations[i])) << i;
  });
}

TEST_P(DerivedEquations, HaveASymmetricPositiveDefiniteMassMatrix) {
  const Lagrangian copy = copied(model().lagrangian);
  const Matrix mass = mass_matrix(copy);
  each_state([&](const Values& state) {
    const auto m = values_of(mass, state);
    for (std::size_t i = 0; i < m.size(); ++i) {
      const double divisor = value_of(model().equations.equations[i].divided_by, state);
      for (std::size_t j = 0; j < m.size(); ++j) {
        const test::Terms entry{m[i][j], m[i][i], m[j][j]};  // |m_ij|^2 <= m_ii m_jj bounds its terms
        EXPECT_LE(std::abs(m[i][j] - m[j][i]), test::round_off * entry.size);
        const double divided = value_of(model().equations.mass_matrix[i][j], state);
        EXPECT_LE(std::abs(divided * divisor - m[i][j]), test::round_off * entry.size) << i << j;
      }
    }
    for (const double pivot : pivots(m)) EXPECT_GT(pivot, 0);
  });
}

class Determinant : public test::SystemTest {};
INSTANTIATE_TEST_SUITE_P(Systems, Determinant,
                         testing::Values("spring_pendulum", "forced_spring_pendulum", "cart_pendulum",
                                         "rod_pendulum", "free_spin_pendulum", "compass_walker",
                                         "spherical_pendulum", "kepler", "foucault"),
                         test::system_name);

TEST_P(Determinant, IsTheOneWrittenByHand) {
  each_state([&](const Values& state) {
    const double paper = *mechanics_of(GetParam(), state).determinant;
    double product = value_of(*model().equations.determinant, state);
    for (const Equation& e : model().equations.equations) product *= value_of(e.divided_by, state);
    EXPECT_NEAR(product, paper,
                test::round_off * paper);  // not of its terms: the written form cancels nothing
  });
}

TEST(EquationsOfMotion, OfTheTriplePendulumCompiledSatisfyThoseWrittenByHand) {
  const auto model = test::model_of("triple_pendulum");
  const Dynamics dynamics(model);
  test::Random random(4);
  for (int i = 0; i < test::identity_states; ++i) {
    Values state = test::random_state(*model, random);
    const std::vector<double> accelerations = test::outputs_of(dynamics.accelerations(), *model, state);
    for (std::size_t k = 0; k < 3; ++k) state["q" + std::to_string(k + 1) + "_ddot"] = accelerations[k];
    for (test::Terms equation : mechanics_of("triple_pendulum", state).equations)
      EXPECT_LE(std::abs(equation.value), test::round_off * equation.size);
  }
}

TEST(EquationsOfMotion, OfTheWalkerAreRegularWithMasslessFeet) {
  const auto model = test::model_of("compass_walker");
  const Dynamics dynamics(model);
  test::Random random(3);
  for (int i = 0; i < test::identity_states; ++i) {
    Values state = test::random_state(*model, random);
    state["m"] = 0;
    EXPECT_DOUBLE_EQ(value_of(*model->equations.determinant, state),
                     state.at("M") * std::pow(state.at("l"), 2));
    const test::Mechanics paper = mechanics_of("compass_walker", state);
    const std::vector<double> accelerations = test::outputs_of(dynamics.accelerations(), *model, state);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_TRUE(agrees(accelerations[k], paper.accelerations[k]));
  }
}

TEST(EquationsOfMotion, AreDividedByTheFactorsOfAllTheirTerms) {
  const auto divided_by = [](const std::string& system, std::size_t i, const Values& state) {
    return value_of(test::model_of(system)->equations.equations[i].divided_by, state);
  };
  EXPECT_EQ(divided_by("cart_pendulum", 1, {{"m", 3}, {"l", 5}}), 15);
  EXPECT_EQ(divided_by("compass_walker", 1, {{"m", 3}, {"l", 5}}), 15);
  EXPECT_EQ(divided_by("rod_spring_pendulum", 1, {{"m", 3}, {"r", 5}}), 15);
}

}  // namespace
}  // namespace qdot
