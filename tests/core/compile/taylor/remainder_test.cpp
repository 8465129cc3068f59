// The bound of a step's defect against the defect itself, at many places of the step.

#include "core/compile/taylor/remainder.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/compile/taylor/composition.hpp"
#include "core/compile/taylor/expansion.hpp"
#include "tests/core/compile/taylor/formula.hpp"
#include "tests/support/motions.hpp"
#include "tests/support/states.hpp"
#include "tests/support/system_test.hpp"

namespace qdot {
namespace {

/// One motion's polynomials and what they may hide until h.
struct Step {
  unsigned order;
  double h;
  std::vector<double> c, defect, closest;

  Step(const CompiledFunction& tape, std::span<const double> parameters, double t, std::vector<double> y,
       unsigned order_of_step, double length)
      : order(order_of_step),
        h(length),
        c(y.size() * (order_of_step + 1)),
        defect(y.size()),
        closest(defect) {
    TaylorExpansion expansion(tape, parameters);
    EXPECT_EQ(expansion.expand(t, y, order, c), Evaluation::ok);
    (void)expansion.bound_defect(h, {}, closest);
    (void)expansion.bound_defect(h, std::vector<double>(y.size(), 1), defect);
  }

  [[nodiscard]] double value(std::size_t i, double s) const {
    double sum = 0;
    for (unsigned k = order + 1; k-- > 0;) sum = sum * s + c[i * (order + 1) + k];
    return sum;
  }
  [[nodiscard]] double slope(std::size_t i, double s) const {
    double sum = 0;
    for (unsigned k = order; k >= 1; --k) sum = sum * s + k * c[i * (order + 1) + k];
    return sum;
  }
  /// |p_i' - f_i| at s, with the acceleration from the tape.
  [[nodiscard]] double defect_at(const CompiledFunction& tape, Workspace& workspace, double t, std::size_t i,
                                 double s) const {
    const std::size_t n = defect.size() / 2;
    std::vector<double> y, a(n);
    for (std::size_t k = 0; k < 2 * n; ++k) y.push_back(value(k, s));
    EXPECT_EQ(tape.evaluate(t + s, y, workspace, a), Evaluation::ok);
    return std::abs(slope(i, s) - (i < n ? y[n + i] : a[i - n]));
  }
};

const char* const formulas[]{"-sin(q)",
                             "cos(q)*q_dot",
                             "tan(q/2)",
                             "asin(q/3)",
                             "acos(q/3)",
                             "atan(3*q)",
                             "sinh(q)",
                             "cosh(q/2)",
                             "tanh(5*q)",
                             "exp(-q^2)",
                             "log(2 + q)",
                             "sqrt(1 + q^2)",
                             "(1 + q^2)^(5/3)",
                             "1/(2 + q)",
                             "q^3 - q*q_dot/(1 + t)",
                             "cos(3*t)*q",
                             "exp(sin(q))/sqrt(2 + cos(t))",
                             "q^7",
                             "(1 - 2*cos(q))*q_dot",
                             "sin(q - 2*t)*(3 + t)",
                             "(q + q_dot/3)*sin(q)",
                             "0",
                             "t",
                             "exp(-((t - 2)/0.1)^2)",
                             "1/(1 + ((t - 2)/0.05)^2)",
                             "tanh((t - 2)/0.02) - tanh((t - 3)/0.02)",
                             "10*exp(-((q - 0.8)/0.1)^2)",
                             "abs(q - 0.5)",
                             "-sign(q - 0.5)*q_dot",
                             "(t/3)^40",
                             "tan(q_dot + t)",
                             "log(1.01 + sin(5*t))",
                             "acos(t/4)",
                             "sqrt(3.2 - t)",
                             "cosh(t - 2)^-2",
                             "(2.5 - t)^(-3/2)",
                             "exp(q_dot)*tanh(q_dot)",
                             "1/cosh((t - 2)/0.001)^2",
                             "sinh((t - 2)/0.01)/cosh((t - 2)/0.01)^3",
                             "exp((t - 2)/0.002)/(1 + exp((t - 2)/0.002))^2",
                             "exp(-cosh((t - 2)/0.001))",
                             "tanh(sinh((t - 2)/0.001))",
                             "sqrt((t - 2)^2 + 1e-12)",
                             "sqrt((t - 1.5)^2 + 1e-4)",
                             "q_dot*sqrt((q - 0.3)^2 + 1e-10)",
                             "((t - 2)^2 + 1e-8)^(3/2)",
                             "asin(1 - (t - 2)^2/5 - 1e-9)"};

TEST(Remainder, IsNeverBelowTheDefect) {
  test::Random random(8);
  int finite = 0, cases = 0;
  for (const char* formula : formulas) {
    const CompiledFunction tape = test::function_of(formula);
    Workspace workspace = tape.bind({});
    for (int i = 0; i < 60; ++i) {
      const double t = random.real(0, 2), h = std::pow(10.0, random.real(-2.5, 0.2));
      const unsigned order = random.real(0, 1) < 0.5 ? 16 : 20;
      const Step step(tape, {}, t, {random.real(-0.6, 0.6), random.real(-0.5, 0.5)}, order, h);
      ++cases;
      if (!std::isfinite(step.defect[1])) continue;
      ++finite;
      for (int k = 1; k <= 100; ++k) {
        const double s = h * k / 100;
        for (const std::size_t j : {0U, 1U}) {
          const double size = std::abs(step.slope(j, s)) + std::abs(step.value(1, s));
          EXPECT_LE(step.defect_at(tape, workspace, t, j, s), step.closest[j] + 1e-12 * (1 + size))
              << formula << " t " << t << " h " << h << " s " << s;
        }
      }
      EXPECT_LE(step.closest[1], step.defect[1] * (1 + 1e-6)) << formula << " t " << t << " h " << h;
    }
  }
  EXPECT_GT(finite, cases * 3 / 4);
}

TEST(Remainder, IsNotHiddenByAStepSoShortThatItsPowersUnderflow) {
  const CompiledFunction tape = test::function_of("-1e84*q");
  Workspace workspace = tape.bind({});
  const Step step(tape, {}, 0, {1e-150, 1e-108}, 8, 1e-42);
  for (const std::size_t j : {0U, 1U})
    EXPECT_LE(step.defect_at(tape, workspace, 0, j, step.h), std::min(step.closest[j], step.defect[j]));
}

TEST(Remainder, IsSmallWhereAStepIsUsual) {
  for (const char* formula : {"-sin(q)", "exp(-q^2)", "q^3 - q*q_dot/(1 + t)", "tanh(q)", "sqrt(1 + q^2)",
                              "1/(2 + q)", "(1 + q^2)^(5/3)", "log(2 + q)", "atan(q)", "abs(q)*q_dot"}) {
    const Step step(test::function_of(formula), {}, 0.3, {0.4, -0.3}, 20, 0.1);
    EXPECT_LT(step.defect[1], 1e-12) << formula;
  }
}

TEST(Remainder, SeesAPulseWhereAllCoefficientsAreZero) {
  const Step before(test::function_of("exp(-((t - 5)/0.1)^2)"), {}, 0, {0, 0}, 20, 10);
  EXPECT_EQ(before.c, std::vector<double>(42));
  EXPECT_GE(before.defect[1], 1);
  const Step short_of_it(test::function_of("exp(-((t - 5)/0.1)^2)"), {}, 0, {0, 0}, 20, 4);
  EXPECT_LT(short_of_it.defect[1], 1e-40);
}

TEST(Remainder, SeesAPulseFromWhereItsDenominatorIsInfinite) {
  for (const char* formula :
       {"1/cosh((t - 5)/0.001)^2", "3/(exp((t - 5)/0.001) + exp((5 - t)/0.001))", "exp(-cosh((t - 5)/0.001))",
        "sinh((t - 5)/0.001)/cosh((t - 5)/0.001)^3", "exp((t - 5)/0.001)/(1 + exp((t - 5)/0.001))^2"}) {
    const CompiledFunction tape = test::function_of(formula);
    const Step before(tape, {}, 0, {0, 0}, 20, 10);
    EXPECT_EQ(before.c, std::vector<double>(42)) << formula;
    EXPECT_GE(before.defect[1], 0.25) << formula;
    EXPECT_LT(Step(tape, {}, 0, {0, 0}, 20, 4.9).defect[1], 1e-40) << formula;
    EXPECT_GT(Step(tape, {}, 4.9995, {0, 0}, 20, 1e-4).c[23], 0.04) << formula;  // and its series are back
  }
}

TEST(Remainder, OfASaturatedTanhIsBelowTheDigitsOfDoubles) {
  EXPECT_LT(Step(test::function_of("tanh((t - 5)/0.1)"), {}, 0, {0, 0}, 24, 0.5).defect[1], 1e-30);
}

TEST(Remainder, SeesAKinkAheadAndNoneBehind) {
  const CompiledFunction tape = test::function_of("sign(q - 0.5)");
  EXPECT_GE(Step(tape, {}, 0, {0.4, 1}, 20, 0.2).defect[1], 2);
  EXPECT_EQ(Step(tape, {}, 0, {0.4, 1}, 20, 0.05).defect[1], 0);
  EXPECT_EQ(Step(tape, {}, 0, {0.5 + 1e-12, 1}, 20, 0.2).defect[1], 0);
}

/// (1 - t)^2 + 1e-16 rounds to a square, and 1 - t is a root of that: the other one from t = 1 on.
TEST(Remainder, SeesWhereRoundingMakesTheRowAnotherFunctions) {
  for (const char* formula :
       {"sqrt((t - 1)^2 + 1e-16)", "((t - 1)^2 + 1e-16)^(3/2)", "(t - 1)^2/((t - 1)^2 + 1e-16)"}) {
    const CompiledFunction tape = test::function_of(formula);
    Workspace workspace = tape.bind({});
    const Step step(tape, {}, 0, {0, 0}, 20, 3);
    for (const double s : {1.0, 2.0, 3.0})
      EXPECT_LE(step.defect_at(tape, workspace, 0, 1, s), step.defect[1]) << formula << " at " << s;
    EXPECT_LT(Step(tape, {}, 0, {0, 0}, 20, 0.5).defect[1], 1e-14) << formula;
  }
}

class RemainderOfSystems : public test::SystemTest {};
INSTANTIATE_TEST_SUITE_P(Systems, RemainderOfSystems, testing::ValuesIn(test::all_systems()),
                         test::system_name);

TEST_P(RemainderOfSystems, IsNeverBelowTheDefectAndFoundForUsualSteps) {
  const Dynamics dynamics(test::model_of(GetParam()));
  const CompiledFunction& tape = dynamics.accelerations();
  test::Random random(12);
  int finite = 0;
  for (int i = 0; i < 60; ++i) {
    const Values state = test::random_state(model(), random);
    const std::vector<double> parameters = test::parameters_in(model(), state);
    const double h = std::pow(10.0, random.real(-3, -0.5));
    const Step step(tape, parameters, 0.3, test::motion_in(model(), state), 18, h);
    Workspace workspace = tape.bind(parameters);
    const std::size_t n = step.defect.size() / 2;
    for (std::size_t j = 0; j < 2 * n; ++j) {
      if (!std::isfinite(step.defect[j])) continue;
      ++finite;
      for (int k = 1; k <= 20; ++k) {
        const double s = h * k / 20;
        const double size = std::abs(step.slope(j, s)) + std::abs(step.slope(j, 0));
        EXPECT_LE(step.defect_at(tape, workspace, 0.3, j, s), step.defect[j] + 1e-9 * (1 + size)) << s;
      }
    }
  }
  EXPECT_GT(finite, 60);
}

TEST(Remainder, IsFoundWhereTheMassMatrixMovesFar) {
  const Dynamics dynamics(test::model_of("rod_spring_pendulum"));
  const std::vector<double> parameters{0.5, 0.5, 40, 0.4, 9.81};
  test::Random random(15);
  int found = 0;
  for (int i = 0; i < 100; ++i) {
    std::vector<double> y{random.real(-0.7, 0.7), random.real(-0.7, 0.7), random.real(0.4, 0.8)};
    for (const double fastest : {4, 4, 3}) y.push_back(random.real(-fastest, fastest));
    const Step step(dynamics.accelerations(), parameters, 0, y, 18, 0.035);
    found += std::isfinite(step.defect[3]) ? 1 : 0;
  }
  EXPECT_GE(found, 98);
}

/// From rest, before the force sets in, all coefficients are 0: after it the defect is M^-1 F, and what is
/// stated has to be as large and little more, while the entries of M move.
TEST(Remainder, OfThreeUnknownsIsCloseToTheDefect) {
  constexpr double little_more = 5;  // minors that are 0 at first are bounded from both sides
  Scene scene;
  scene.name = "three_coupled";
  scene.without_units = true;
  for (const char* name : {"x", "y", "z"}) scene.coordinates.push_back({name, "1", "0", "0", "", {}, "", ""});
  for (const char* pushed : {"x", "y", "z"}) {
    scene.lagrangian =
        "(2 + sin(t))*x_dot^2/2 + (2 - t/3)*y_dot^2/2 + z_dot^2 + t*x_dot*y_dot/2 + cos(t)*y_dot*z_dot/3 + "
        "(1 + sign(t - 0.39))*" +
        std::string(pushed);
    const Dynamics dynamics(build_model(scene));
    const Step step(dynamics.accelerations(), {}, 0, std::vector<double>(6), 20, 0.4);
    EXPECT_EQ(step.c, std::vector<double>(step.c.size()));
    Workspace workspace = dynamics.accelerations().bind({});
    for (std::size_t i = 3; i < 6; ++i) {
      const double defect = step.defect_at(dynamics.accelerations(), workspace, 0, i, step.h);
      EXPECT_GE(step.defect[i], defect) << pushed << ' ' << i;
      EXPECT_LE(step.defect[i], little_more * defect) << pushed << ' ' << i;
    }
  }
}

/// g along the polynomials of a motion.
TEST(Composition, IsWithinItsBound) {
  test::Random random(9);
  const CompiledFunction pendulum = test::function_of("-sin(q)");
  int finite = 0, cases = 0;
  for (const char* formula : formulas) {
    const auto g = std::make_shared<const CompiledFunction>(test::function_of(formula));
    TaylorComposition composition(g, {});
    Workspace workspace = g->bind({});
    for (int i = 0; i < 40; ++i) {
      const double t = random.real(0, 2), h = std::pow(10.0, random.real(-2.5, 0));
      const Step step(pendulum, {}, t, {random.real(-0.6, 0.6), random.real(-0.5, 0.5)}, 20, h);
      const unsigned order = i % 2 == 0 ? 5 : 20;
      std::vector<double> c(order + 1);
      const double r = composition.expand(t, step.c, step.order, h, order, c);
      ++cases;
      if (!std::isfinite(r)) continue;
      ++finite;
      for (int k = 0; k <= 50; ++k) {
        const double s = h * k / 50;
        double value{}, sum = 0;
        ASSERT_EQ(g->evaluate(t + s, std::vector<double>{step.value(0, s), step.value(1, s)}, workspace,
                              {&value, 1}),
                  Evaluation::ok);
        for (unsigned j = order + 1; j-- > 0;) sum = sum * s + c[j];
        EXPECT_LE(std::abs(value - sum), r + 1e-12 * (1 + std::abs(value))) << formula << " " << t + s;
      }
    }
  }
  EXPECT_GT(finite, cases * 3 / 4);
}

/// The argument is below zero where q is within 6e-9 of its least value, and doubles have it positive or
/// zero.
TEST(Composition, CountsTheRoundingThatFlatFunctionsHide) {
  const CompiledFunction free = test::function_of("0*q");
  for (const char* formula :
       {"sign(sqrt(1 + (q - 0.25)^2) - 1 - 2e-17)", "tanh(1e18*(sqrt(1 + (q - 0.25)^2) - 1 - 2e-17))",
        "sign(2*(q + 3)*(sqrt(1 + (q - 0.25)^2) - 1 - 2e-17))"}) {
    TaylorComposition composition(std::make_shared<const CompiledFunction>(test::function_of(formula)), {});
    const auto off = [&](double q) {
      std::vector<double> c(6);
      const Step step(free, {}, 0, {q, 1}, 20, 1e-7);
      return composition.expand(0, step.c, step.order, step.h, 5, c);
    };
    EXPECT_GE(off(0.25 - 5e-8), 1) << formula;
    EXPECT_LT(off(0.125), 1e-6) << formula;
  }
}

/// How far g of a state in [0, h] is from coefficients that are good to r: the largest of what exceeds r.
double excess(const CompiledFunction& g, std::span<const double> parameters, const Step& step,
              std::span<const double> c, double r) {
  Workspace workspace = g.bind(parameters);
  double most = -infinity;
  for (int k = 0; k <= 50; ++k) {
    const double s = step.h * k / 50;
    std::vector<double> y;
    for (std::size_t i = 0; i < step.defect.size(); ++i) y.push_back(step.value(i, s));
    double value{}, sum = 0;
    EXPECT_EQ(g.evaluate(s, y, workspace, {&value, 1}), Evaluation::ok);
    for (std::size_t j = c.size(); j-- > 0;) sum = sum * s + c[j];
    most = std::max(most, std::abs(value - sum) - r - 1e-12 * (1 + std::abs(value)));
  }
  return most;
}

TEST(Composition, TakesAccelerationsFromTheSlopesOfVelocities) {
  const auto model = test::model_of("rod_pendulum");
  const Dynamics dynamics(model);
  const std::vector<double> parameters = parameter_values(*model, {});
  test::Random random(16);
  int finite = 0;
  for (const Column& condition : validity_columns(*model)) {
    const auto by_accelerations = dynamics.by_accelerations(condition.value);
    ASSERT_NE(by_accelerations, nullptr);
    EXPECT_EQ(by_accelerations->variables(), 6U);
    TaylorComposition composition(by_accelerations, parameters, Variables::state_and_accelerations);
    for (int i = 0; i < 60; ++i) {
      std::vector<double> y;
      for (int k = 0; k < 4; ++k) y.push_back(random.real(-1, 1));
      const Step step(dynamics.accelerations(), parameters, 0, y, 20, std::pow(10.0, random.real(-2.5, -1)));
      std::vector<double> c(i % 2 == 0 ? 6 : 21);
      const auto order = static_cast<unsigned>(c.size() - 1);
      const double r = composition.expand(0, step.c, step.order, step.h, order, c, step.defect);
      if (!std::isfinite(r)) continue;
      ++finite;
      EXPECT_LE(excess(*dynamics.columns({condition}), parameters, step, c, r), 0) << condition.name;
    }
  }
  EXPECT_GE(finite, 50);
}

TEST(Composition, OfAPositionNeedsNoAccelerations) {
  const auto model = test::model_of("rod_pendulum");
  EXPECT_EQ(Dynamics(model).by_accelerations(model->parsed.symbols.coordinates.rate[0]), nullptr);
}

}  // namespace
}  // namespace qdot
