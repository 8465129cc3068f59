// Coefficients by recurrence are the derivatives of the motion.

#include "core/compile/taylor/expansion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/compile/taylor/formula.hpp"
#include "tests/support/motions.hpp"
#include "tests/support/states.hpp"
#include "tests/support/system_test.hpp"

namespace qdot::expansion_test {
namespace {

constexpr unsigned order = TaylorExpansion::highest_order;

double value_at(std::span<const double> coefficients, std::size_t i, double s) {
  double sum = 0;
  for (unsigned k = order + 1; k-- > 0;) sum = sum * s + coefficients[i * (order + 1) + k];
  return sum;
}

/// The k-th derivative of the series obeys the equation: y'' at s, from the polynomial, is a(t + s, y(s)).
class Recurrence : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Formulas, Recurrence,
                         testing::Values("-sin(q)", "cos(q)*q_dot", "tan(q/2)", "asin(q/3)", "acos(q/3)",
                                         "atan(q)", "sinh(q)", "cosh(q/2)", "tanh(q)", "exp(-q^2)",
                                         "log(2 + q)", "sqrt(1 + q^2)", "(1 + q^2)^(5/3)", "1/(2 + q)",
                                         "q^3 - q*q_dot/(1 + t)", "cos(3*t)*q",
                                         "exp(sin(q))/sqrt(2 + cos(t))", "q^7", "(1 - 2*cos(q))*q_dot",
                                         "sin(q - 2*t)*(3 + t)", "abs(q)*q_dot", "abs(q_dot) - sign(q_dot)*t",
                                         "(q + q_dot/3)*sin(q)", "0", "2", "t"));

TEST_P(Recurrence, SolvesTheEquation) {
  const CompiledFunction tape = test::function_of(GetParam());
  TaylorExpansion expansion(tape, {});
  const std::vector<double> y{0.4, -0.3};
  std::vector<double> c(2 * (order + 1));
  ASSERT_EQ(expansion.expand(0.7, y, order, c), Evaluation::ok);
  Workspace workspace = tape.bind({});
  for (const double s : {-0.05, 0.02, 0.05}) {
    const std::vector<double> state{value_at(c, 0, s), value_at(c, 1, s)};
    double a{};
    ASSERT_EQ(tape.evaluate(0.7 + s, state, workspace, {&a, 1}), Evaluation::ok);
    double rate = 0;
    for (unsigned k = order; k >= 1; --k) rate = rate * s + k * c[order + 1 + k];
    EXPECT_NEAR(rate, a, 4e-14 * (1 + std::abs(a))) << s;
  }
}

TEST(TaylorExpansion, SaysWhereTheStateHasNoDerivative) {
  const CompiledFunction tape = test::function_of("1/q");
  TaylorExpansion at_pole(tape, {});
  std::vector<double> c(2 * (order + 1));
  EXPECT_EQ(at_pole.expand(0, std::vector<double>{0, 1}, order, c), Evaluation::nonfinite);
}

/// (J + e I) q'' = -e g with J all ones: q'' = sum g/(3 + e) - g. Cofactors would lose twice the digits.
TEST(TaylorExpansion, OfThreeUnknownsNearlyTiedTogether) {
  Scene scene;
  scene.name = "nearly_tied";
  scene.without_units = true;
  scene.parameters.push_back({"e", "1", "1e-6", {}, "", ""});
  for (const char* name : {"x", "y", "z"}) scene.coordinates.push_back({name, "1", "0", "0", "", {}, "", ""});
  scene.lagrangian =
      "(x_dot + y_dot + z_dot)^2/2 + e*(x_dot^2 + y_dot^2 + z_dot^2)/2 - e*(x^4 + y^4/2 + z^4/3)/4";
  const Dynamics dynamics(build_model(scene));
  constexpr double e = 1e-6;
  TaylorExpansion expansion(dynamics.accelerations(), std::vector<double>{e});
  const std::vector<double> y{0.3, -0.2, 0.4, 0.1, 0.5, -0.6};
  std::vector<double> c(y.size() * 3), rate(3);
  ASSERT_EQ(expansion.expand(0, y, 2, c), Evaluation::ok);
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    rate[i] = 3 * y[i] * y[i] * y[3 + i] / static_cast<double>(i + 1);
    sum += rate[i];
  }
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(2 * c[3 * (3 + i) + 2], sum / (3 + e) - rate[i], 1e-8) << i;
}

/// q'' = A q with q' = q for now: then A q' is A q to the last bit, whatever A is rounded to.
TEST(TaylorExpansion, TakesTheSameNumbersInAllItsCoefficients) {
  const std::vector<std::vector<const char*>> coordinates{{"x"}, {"x", "y"}, {"x", "y", "z"}};
  const std::vector<const char*> lagrangians{
      "0.7*u*x_dot^2 - 1.3*w*x^2",
      "0.7*u*x_dot^2 + 0.3*x_dot*y_dot + 0.45*u*y_dot^2 - 0.9*w*x^2 - 0.8*(x - y)^2",
      "0.7*u*x_dot^2 + 0.3*x_dot*y_dot + 0.45*u*y_dot^2 + 0.35*z_dot^2 + 0.21*x_dot*z_dot - 0.9*w*x^2 - "
      "0.8*(x - y)^2 - 0.77*(y - z)^2"};
  for (std::size_t n = 1; n <= 3; ++n) {
    Scene scene;
    scene.name = "coupled_masses";
    scene.without_units = true;
    for (const char* name : {"u", "w"}) scene.parameters.push_back({name, "1", "1", {}, "", ""});
    for (const char* name : coordinates[n - 1])
      scene.coordinates.push_back({name, "1", "0", "0", "", {}, "", ""});
    scene.lagrangian = lagrangians[n - 1];
    const Dynamics dynamics(build_model(scene));
    for (const double u : {1.1, 0.93, 3.7}) {
      TaylorExpansion expansion(dynamics.accelerations(), std::vector<double>{u, 1.7});
      const std::vector<double> q{0.41, -0.37, 0.73};
      std::vector<double> y(q.begin(), q.begin() + static_cast<std::ptrdiff_t>(n));
      y.insert(y.end(), q.begin(), q.begin() + static_cast<std::ptrdiff_t>(n));
      std::vector<double> c(y.size() * 3);
      ASSERT_EQ(expansion.expand(0, y, 2, c), Evaluation::ok);
      for (std::size_t i = n; i < 2 * n; ++i) EXPECT_EQ(2 * c[3 * i + 2], c[3 * i + 1]) << n << ' ' << u;
    }
  }
}

/// Where cofactors leave the range of doubles a matrix is inverted by elimination.
TEST(TaylorExpansion, OfThreeUnknownsDoesNotDependOnTheUnitOfMass) {
  Scene scene;
  scene.name = "three_coupled";
  scene.without_units = true;
  for (const char* name : {"u", "w"}) scene.parameters.push_back({name, "1", "1", {}, "", ""});
  for (const char* name : {"x", "y", "z"}) scene.coordinates.push_back({name, "1", "0", "0", "", {}, "", ""});
  scene.lagrangian =
      "u*(x_dot^2 + (2 - sin(z))*y_dot^2/2 + z_dot^2 + sin(x)*x_dot*y_dot/2 + cos(y)*y_dot*z_dot/3 - cos(x - "
      "z)*x_dot*z_dot/4) - w*(x*y*z + z^2)";
  const Dynamics dynamics(build_model(scene));
  const std::vector<double> y{0.4, -0.3, 0.7, 1.1, -0.6, 0.2};
  std::vector<double> usual(y.size() * (order + 1)), other(usual.size());
  TaylorExpansion expansion(dynamics.accelerations(), std::vector<double>{1, 1});
  ASSERT_EQ(expansion.expand(0, y, order, usual), Evaluation::ok);
  for (const double u : {3e-110, 7e-20, 3e20, 7e110}) {
    TaylorExpansion of_other(dynamics.accelerations(), std::vector<double>{u, u});
    ASSERT_EQ(of_other.expand(0, y, order, other), Evaluation::ok);
    for (std::size_t i = 0; i < usual.size(); ++i)
      EXPECT_NEAR(other[i], usual[i], 1e-10 * std::abs(usual[i]) + 1e-13) << u << ' ' << i;
  }
}

class TaylorOfSystems : public test::SystemTest {};
INSTANTIATE_TEST_SUITE_P(Systems, TaylorOfSystems, testing::ValuesIn(test::all_systems()), test::system_name);

TEST_P(TaylorOfSystems, HasTheSameBitsOnEveryProcessor) {
  const Dynamics dynamics(test::model_of(GetParam()));
  test::Random random(11);
  for (int i = 0; i < 20; ++i) {
    const Values state = test::random_state(model(), random);
    const std::vector<double> parameters = test::parameters_in(model(), state);
    const std::vector<double> y = test::motion_in(model(), state);
    TaylorExpansion best(dynamics.accelerations(), parameters);
    TaylorExpansion plain(dynamics.accelerations(), parameters, InstructionSet::plain);
    for (const unsigned n : {1U, 2U, 7U, 14U, 20U, order}) {
      std::vector<double> a(y.size() * (n + 1)), b(a.size());
      ASSERT_EQ(best.expand(0.3, y, n, a), plain.expand(0.3, y, n, b));
      EXPECT_EQ(a, b) << n;
      if (n < 7) continue;
      const std::vector<double> allowed(y.size(), 1e-9);
      std::vector<double> of_best(y.size()), of_plain(y.size());
      EXPECT_EQ(best.bound_defect(0.1, allowed, of_best), plain.bound_defect(0.1, allowed, of_plain)) << n;
      EXPECT_EQ(of_best, of_plain) << n;
    }
  }
}

}  // namespace
}  // namespace qdot::expansion_test
