// The derived forms are written with no more operations than the practice sheet's own, restored and
// corrected.

#include <gtest/gtest.h>

#include "core/expr/print/print.hpp"
#include "core/expr/simplify.hpp"
#include "core/mechanics/dimensionless.hpp"
#include "core/mechanics/notation.hpp"
#include "tests/support/operation_count.hpp"
#include "tests/support/scenes.hpp"

namespace qdot::printed_forms_test {
namespace {

std::string text_of(const Expression& e, const Model& model) {
  return print(e, Form::text, notation_of(model.scene));
}

enum class Quantity { kinetic, potential, equation, acceleration };

/// How the sheet prints a quantity of a system; `index` counts equations and accelerations. An equation is
/// what stands in left = right with all of L on the left, divided by the factor that its terms share.
struct Printed {
  std::string system;
  Quantity quantity;
  std::size_t index;
  std::string sheet;
};

void PrintTo(const Printed& row, std::ostream* out) { *out << row.system << ": " << row.sheet; }

const std::vector<Printed> table{
    {"spring_pendulum", Quantity::kinetic, 0, "1/2*m*(l_dot^2 + l^2*theta_dot^2)"},       // (1)
    {"spring_pendulum", Quantity::potential, 0, "-m*g*l*cos(theta) + 1/2*k*(l - l0)^2"},  // (2)
    {"spring_pendulum", Quantity::equation, 0,                                            // (5)
     "m*l_ddot - m*l*theta_dot^2 - m*g*cos(theta) + k*(l - l0)"},
    {"spring_pendulum", Quantity::equation, 1, "l*theta_ddot + 2*l_dot*theta_dot + g*sin(theta)"},  // (6)
    {"forced_spring_pendulum", Quantity::equation, 0,
     "m*l_ddot - m*l*theta_dot^2 - m*g*cos(theta) + k*(l - l0) = F*sin(theta)"},
    {"forced_spring_pendulum", Quantity::equation, 1,
     "m*l*theta_ddot + 2*m*l_dot*theta_dot + m*g*sin(theta) = F*cos(theta)"},
    {"rolling_disk_platform", Quantity::kinetic, 0,  // (17)
     "3/4*m*q_dot^2 - 3/2*m*r*Omega*q_dot + 1/2*m*Omega^2*q^2 + 3/4*m*Omega^2*r^2"},
    {"rolling_disk_platform", Quantity::potential, 0, "m*g*(q*sin(Omega*t) + r*cos(Omega*t))"},
    {"rolling_disk_platform", Quantity::acceleration, 0, "2/3*(Omega^2*q - g*sin(Omega*t))"},
    {"cart_pendulum", Quantity::kinetic, 0,  // (21), with M + m for 3m
     "1/2*(M + m)*x_dot^2 + 1/2*m*l^2*theta_dot^2 + m*l*x_dot*theta_dot*cos(theta)"},
    {"cart_pendulum", Quantity::potential, 0, "1/2*k*x^2 - m*g*l*cos(theta)"},  // (22)
    {"cart_pendulum", Quantity::equation, 0,
     "(M + m)*x_ddot + m*l*theta_ddot*cos(theta) - m*l*theta_dot^2*sin(theta) + k*x"},
    {"cart_pendulum", Quantity::equation, 1, "l*theta_ddot + x_ddot*cos(theta) + g*sin(theta)"},
    {"cart_pendulum", Quantity::acceleration, 0,
     "(m*sin(theta)*(l*theta_dot^2 + g*cos(theta)) - k*x)/(M + m*sin(theta)^2)"},
    {"rod_pendulum", Quantity::kinetic, 0,  // (37)
     "1/2*m*l^2*(4/3*theta_dot^2 + phi_dot^2 + 2*theta_dot*phi_dot*cos(theta - phi))"},
    {"rod_pendulum", Quantity::potential, 0, "-m*g*l*(3/2*cos(theta) + cos(phi))"},  // (38)
    {"rod_pendulum", Quantity::equation, 0,
     "4/3*theta_ddot + cos(theta - phi)*phi_ddot + phi_dot^2*sin(theta - phi) + 3/2*g/l*sin(theta)"},
    {"rod_pendulum", Quantity::equation, 1,
     "phi_ddot + cos(theta - phi)*theta_ddot - theta_dot^2*sin(theta - phi) + g/l*sin(phi)"},
    {"rod_spring_pendulum", Quantity::kinetic, 0,
     "1/6*m*l^2*theta_dot^2 + 1/2*m*(l^2*theta_dot^2 + r_dot^2 + r^2*phi_dot^2 + "
     "2*l*theta_dot*(r*phi_dot*cos(theta - phi) + r_dot*sin(phi - theta)))"},
    {"rod_spring_pendulum", Quantity::potential, 0,
     "-3/2*m*g*l*cos(theta) - m*g*r*cos(phi) + 1/2*k*(r - l0)^2"},
    {"rod_spring_pendulum", Quantity::equation, 1,
     "r*phi_ddot + 2*r_dot*phi_dot + l*(theta_ddot*cos(phi - theta) + theta_dot^2*sin(phi - theta)) + "
     "g*sin(phi)"},
    {"rod_spring_pendulum", Quantity::equation, 2,
     "m*r_ddot - m*(r*phi_dot^2 - l*(theta_ddot*sin(phi - theta) - theta_dot^2*cos(phi - theta)) + "
     "g*cos(phi)) + "
     "k*(r - l0)"},
    {"rod_spring_pendulum", Quantity::acceleration, 0,  // with S = k (r - l0) written out
     "3*(k*(r - l0)*sin(phi - theta)/(m*l) - 1/2*g/l*sin(theta))"},
    {"whirling_pendulum", Quantity::kinetic, 0,
     "1/2*m*l^2*theta_dot^2 + m*R*Omega*l*theta_dot*cos(theta) + 1/2*m*Omega^2*(R^2 + l^2*sin(theta)^2)"},
    {"whirling_pendulum", Quantity::potential, 0, "-m*g*l*cos(theta)"},
    {"whirling_pendulum", Quantity::acceleration, 0, "sin(theta)*(Omega^2*cos(theta) - g/l)"},
    {"orbiting_pendulum", Quantity::kinetic, 0,
     "1/2*m*l^2*phi_dot^2 + m*omega0*phi_dot*(r*l*cos(phi) + l^2) + "
     "m*omega0^2*(r*l*cos(phi) + 1/2*(r^2 + l^2))"},
    {"orbiting_pendulum", Quantity::equation, 0, "phi_ddot + r/l*omega0^2*sin(phi)"},
    {"free_spin_pendulum", Quantity::kinetic, 0,  // (47)
     "1/2*m*(l^2*theta_dot^2 + (l/2 + l*sin(theta))^2*psi_dot^2)"},
    {"free_spin_pendulum", Quantity::potential, 0, "-m*g*l*cos(theta)"},
    {"free_spin_pendulum", Quantity::equation, 0,
     "theta_ddot - psi_dot^2*(1/2 + sin(theta))*cos(theta) + g/l*sin(theta)"},
    {"free_spin_pendulum", Quantity::acceleration, 1, "-2*psi_dot*theta_dot*cos(theta)/(1/2 + sin(theta))"},
    {"compass_walker", Quantity::kinetic, 0,  // M l^2 times the sheet's, with mu M = m
     "1/2*l^2*(M + 4*m*sin(phi/2)^2)*theta_dot^2 - 2*m*l^2*sin(phi/2)^2*theta_dot*phi_dot + "
     "1/2*m*l^2*phi_dot^2"},
    {"compass_walker", Quantity::potential, 0,
     "M*g*l*cos(theta - gamma) + 2*m*g*l*sin(phi/2)*sin(phi/2 - theta + gamma)"},
    {"compass_walker", Quantity::equation, 1,
     "phi_ddot - (1 - cos(phi))*theta_ddot - sin(phi)*theta_dot^2 - g/l*sin(theta - phi - gamma)"},
    {"compass_walker", Quantity::acceleration, 0,
     "((M + m)*g/l*sin(theta - gamma) - m*g/l*cos(phi)*sin(theta - phi - gamma) + "
     "m*sin(phi)*((1 - cos(phi))*theta_dot^2 - 2*theta_dot*phi_dot + phi_dot^2))/(M + m*sin(phi)^2)"},
    {"rotating_l_bar", Quantity::kinetic, 0,  // (63) with (61)
     "1/2*m*l^2*(55/3*theta_dot^2 + Omega^2*(18*sin(theta)^2 + 1/3*cos(theta)^2 - 3*sin(theta)*cos(theta)))"},
    {"rotating_l_bar", Quantity::potential, 0, "-1/2*m*g*l*(15*cos(theta) + sin(theta))"},
    // (62), whose auxiliary sqrt(226)/2 sin(theta - alpha) stands for (15 sin(theta) - cos(theta))/2
    {"rotating_l_bar", Quantity::equation, 0,
     "55/3*theta_ddot - 53/3*Omega^2*sin(theta)*cos(theta) - 3/2*Omega^2*(sin(theta)^2 - cos(theta)^2) + "
     "1/2*g/l*(15*sin(theta) - cos(theta))"},
    {"rotating_l_bar", Quantity::acceleration, 0,
     "3/55*(Omega^2*(53/6*sin(2*theta) - 3/2*cos(2*theta)) - g/l*(15*sin(theta) - cos(theta))/2)"},
};

std::string printed(const Model& model, Quantity quantity, std::size_t index) {
  switch (quantity) {
    case Quantity::kinetic:
      return text_of(*model.lagrangian.kinetic_energy, model);
    case Quantity::potential:
      return text_of(*model.lagrangian.potential_energy, model);
    case Quantity::equation: {
      const Equation& equation = model.equations.equations[index];
      const std::string left = text_of(equation.left, model);
      return equation.right.is_zero() ? left : left + " = " + text_of(equation.right, model);
    }
    case Quantity::acceleration: {
      const Lagrangian copy = copied(model.lagrangian);
      return text_of(solved(augmented(derive_equations(copy), copy))[index], model);
    }
  }
  return "";
}

/// Both sides of an equation together.
std::size_t operations(const std::string& text) {
  const std::size_t equals = text.find(" = ");
  if (equals == std::string::npos) return test::operation_count_of_text(text);
  return test::operation_count_of_text(text.substr(0, equals)) +
         test::operation_count_of_text(text.substr(equals + 3));
}

class PrintedForm : public testing::TestWithParam<Printed> {};
INSTANTIATE_TEST_SUITE_P(Table, PrintedForm, testing::ValuesIn(table));

TEST_P(PrintedForm, IsNoLongerThanTheSheets) {
  const Printed& row = GetParam();
  const std::string derived = printed(*test::model_of(row.system), row.quantity, row.index);
  EXPECT_LE(operations(derived), operations(row.sheet)) << derived << "\n" << row.sheet;
}

TEST(PrintedForm, OfTheKineticEnergyOfProblem3HasTheFourTermsOf17) {
  const auto model = test::model_of("rolling_disk_platform");
  EXPECT_EQ(text_of(*model->lagrangian.kinetic_energy, *model),
            "3/4*m*q_dot^2 - 3/2*m*r*Omega*q_dot + 1/2*m*Omega^2*q^2 + 3/4*m*r^2*Omega^2");
}

TEST(PrintedForm, OfTheKineticEnergyOfProblem8HasTheSquareOf47) {
  const auto model = test::model_of("free_spin_pendulum");
  EXPECT_EQ(text_of(*model->lagrangian.kinetic_energy, *model),
            "1/2*m*l^2*(theta_dot^2 + psi_dot^2*(1/2 + sin(theta))^2)");
}

TEST(PrintedForm, OfTheDimensionlessWalkerIsNoLongerThanTheSheets) {
  const auto model = build_model(test::scene_of("compass_walker"));
  const auto form = dimensionless_form(model->scene, model->parsed, model->lagrangian);
  const std::string sheet =
      "1/2*(1 + 4*mu*sin(phi/2)^2)*theta_dot^2 - 2*mu*sin(phi/2)^2*theta_dot*phi_dot + 1/2*mu*phi_dot^2 - "
      "cos(theta - gamma) - 2*mu*sin(phi/2)*sin(phi/2 - theta + gamma)";
  const std::string derived = text_of(form->lagrangian, *model);
  EXPECT_LE(test::operation_count_of_text(derived), test::operation_count_of_text(sheet)) << derived;
}

/// T and V apart, as the sheet writes every one of its Lagrangians.
TEST(PrintedForm, OfTheLagrangianIsNoLongerThanItsTwoEnergies) {
  for (const std::string& system : test::practice_systems()) {
    const auto model = test::model_of(system);
    const auto count = [&](const Expression& e) { return test::operation_count_of_text(text_of(e, *model)); };
    const std::size_t apart =
        count(*model->lagrangian.kinetic_energy) + count(*model->lagrangian.potential_energy) + 1;
    EXPECT_LE(count(model->lagrangian.lagrangian), apart) << system;
  }
}

}  // namespace
}  // namespace qdot::printed_forms_test
