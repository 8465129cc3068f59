#include "core/grading/same_motion.hpp"

#include <gtest/gtest.h>

#include "core/expr/print/print.hpp"
#include "core/grading/student_parser.hpp"
#include "tests/support/scenes.hpp"

namespace qdot::test {
namespace {

MotionVerdict verdict(const std::string& system, const std::string& submitted,
                      std::optional<std::size_t> coordinate = 0, std::uint64_t seed = 1) {
  const auto model = model_of(system);
  const ExpectedSystem of(*model);
  const Vocabulary vocabulary(of.symbols(), of.momenta());
  const ReadSubmission read = read_submission(submitted, of.graph(), vocabulary);
  EXPECT_TRUE(read.errors.empty()) << submitted << ": " << read.errors.front();
  std::vector<Expression> residuals;
  for (const ReadEquation& equation : read.equations) residuals.push_back(equation.residual());
  return compare_motion(of, residuals, coordinate, seed);
}

MotionFault fault(const std::string& system, const std::string& submitted,
                  std::optional<std::size_t> coordinate = 0) {
  return verdict(system, submitted, coordinate).fault;
}

using enum MotionFault;

TEST(SameMotion, AnEquationMayHaveAnyForm) {
  for (const char* right :
       {"theta'' = sin(theta) (Omega^2 cos(theta) - g/l)",
        "l theta'' - l Omega^2 sin(theta) cos(theta) + g sin(theta) = 0",
        "m l^2 theta'' = m l sin(theta) (l Omega^2 cos(theta) - g)",
        "theta''/sin(theta) = Omega^2 cos(theta) - g/l", "theta'' + g/l sin(theta) = Omega^2/2 sin(2*theta)",
        "1 = sin(theta) (Omega^2 cos(theta) - g/l)/theta''",
        "0 = -theta'' + sin(theta) (Omega^2 cos(theta) - g/l)",
        "d/dt(m l^2 theta') = m l^2 Omega^2 sin(theta) cos(theta) - m g l sin(theta)",
        "Omega^2 = theta''/(sin(theta) cos(theta)) + g/(l cos(theta))"}) {
    EXPECT_EQ(fault("whirling_pendulum", right), none) << right;
  }
  EXPECT_EQ(verdict("whirling_pendulum", "theta'' = sin(theta) (Omega^2 cos(theta) - g/l)").decided_by,
            Decision::identity);
}

TEST(SameMotion, AWrongEquationHasACounterexample) {
  for (const char* wrong :
       {"theta'' = sin(theta) (Omega^2 cos(theta) + g/l)", "theta'' = sin(theta) (Omega^2 sin(theta) - g/l)",
        "theta'' = sin(theta) (Omega cos(theta) - g/l)", "theta'' = theta (Omega^2 - g/l)", "theta'' = 0",
        "theta' = sin(theta)", "theta'' = sin(theta) (Omega^2 cos(theta) - g/l) + 1e-25"}) {
    const MotionVerdict found = verdict("whirling_pendulum", wrong);
    EXPECT_EQ(found.fault, not_true) << wrong;
    EXPECT_FALSE(found.counterexample.empty());
  }
  EXPECT_TRUE(verdict("whirling_pendulum", "theta'' = -g/l sin(theta)").acceleration);
}

TEST(SameMotion, WhatHoldsAlwaysIsNoEquation) {
  for (const char* empty : {"0 = 0", "theta'' = theta''", "sin(theta)^2 + cos(theta)^2 = 1", "m = m",
                            "theta'' - theta'' + theta' = theta'"}) {
    EXPECT_EQ(fault("whirling_pendulum", empty), holds_always) << empty;
  }
}

TEST(SameMotion, WhatIsNotLinearHasToHaveNoOtherSolution) {
  const std::string right = "(theta'' - sin(theta) (Omega^2 cos(theta) - g/l))";
  for (const char* factor :
       {"^2", "^3", "*(theta''^2 + 1)", "*(1 + theta'^2)", "^2*(2 + theta'' + theta''^2)"})
    EXPECT_EQ(fault("whirling_pendulum", right + factor + " = 0"), none) << factor;
  for (const char* factor : {"*theta''", "*(theta'' - theta')", "*(theta''^2 - 1)", "^2*(theta''^2 - 3)"}) {
    const MotionVerdict found = verdict("whirling_pendulum", right + factor + " = 0");
    EXPECT_EQ(found.fault, other_solutions) << factor;
    EXPECT_FALSE(found.counterexample.empty());
  }
  EXPECT_EQ(fault("whirling_pendulum", "theta''^2 = sin(theta)^2 (Omega^2 cos(theta) - g/l)^2"),
            other_solutions);
  EXPECT_EQ(fault("whirling_pendulum", "exp" + right + " = 1"), not_linear);
  EXPECT_EQ(fault("whirling_pendulum", "abs(theta'') = abs(sin(theta) (Omega^2 cos(theta) - g/l))"),
            other_solutions);
  EXPECT_EQ(fault("whirling_pendulum", right + "*(theta'' - 1)^2 = 0"), other_solutions);
  EXPECT_EQ(fault("whirling_pendulum", "exp(theta''^2) = exp((sin(theta) (Omega^2 cos(theta) - g/l))^2)"),
            other_solutions);
}

TEST(SameMotion, SetsThatAreNotLinearHaveToHaveNoOtherSolution) {
  const std::string l = "(m (l'' - l theta'^2 - g cos(theta)) + k (l - l0))";
  const std::string theta = "(l theta'' + 2 l' theta' + g sin(theta))";
  const std::string b = "(k/m (l - l0) - l theta'^2 - g cos(theta))";
  const auto of_both = [](const std::string& first, const std::string& second) {
    return fault("spring_pendulum", first + "\n" + second, std::nullopt);
  };
  EXPECT_EQ(of_both(l + "^2 = 0", theta + " = 0"), none);
  EXPECT_EQ(of_both(l + "^2 = 0", theta + "^3*(1 + l''^2) = 0"), none);
  EXPECT_EQ(of_both("l''^2 + 2 l'' " + b + " + " + b + "^2 = 0", theta + " = 0"), none);
  EXPECT_EQ(of_both(l + "*l'' = 0", theta + " = 0"), other_solutions);
  EXPECT_EQ(of_both("l''^2 = " + b + "^2", theta + " = 0"), other_solutions);
  EXPECT_EQ(of_both(l + " = " + theta + "^2", theta + " = " + l + "^2"), other_solutions);
  EXPECT_EQ(of_both(l + "*" + theta + " = 0", theta + " = 0"), dependent);
  EXPECT_EQ(of_both("exp(" + l + "/m) = 1", theta + " = 0"), not_linear);
  EXPECT_EQ(of_both(l + " = 0", "0 = 0"), holds_always);
}

TEST(SameMotion, WhatIsNotLinearIsLookedAtWhereTheOtherEquationsHold) {
  const std::string l = "(m (l'' - l theta'^2 - g cos(theta)) + k (l - l0))";
  const std::string theta = "(l theta'' + 2 l' theta' + g sin(theta))";
  EXPECT_EQ(fault("spring_pendulum", theta + "^2 = 0", 1), none);
  EXPECT_EQ(fault("spring_pendulum", theta + "*(1 + l''^2) = 0", 1), none);
  EXPECT_EQ(fault("spring_pendulum", theta + "*(1 + " + l + "^2) = 0", 1), none);
  EXPECT_EQ(fault("spring_pendulum", theta + "*theta'' = 0", 1), other_solutions);
  EXPECT_EQ(fault("spring_pendulum", theta + "^2 = 0", 0), other_coordinate);
  EXPECT_EQ(fault("spring_pendulum", l + "*" + theta + " = 0", 1), other_coordinate);
}

TEST(SameMotion, OtherEquationsMayBePutIntoOne) {
  const std::string x = "(M+m) x'' + m l theta'' cos(theta) - m l theta'^2 sin(theta) + k x = 0";
  const std::string theta = "l theta'' + x'' cos(theta) + g sin(theta) = 0";
  EXPECT_EQ(fault("cart_pendulum", x, 0), none);
  EXPECT_EQ(fault("cart_pendulum", theta, 1), none);
  EXPECT_EQ(fault("cart_pendulum", theta, 0), other_coordinate);
  EXPECT_EQ(fault("cart_pendulum", x, 1), other_coordinate);
  EXPECT_EQ(fault("cart_pendulum",
                  "x'' = (m sin(theta) (l theta'^2 + g cos(theta)) - k x)/(M + m sin(theta)^2)", 0),
            none);
  EXPECT_EQ(
      fault("cart_pendulum", "x'' (M + m sin(theta)^2) = m sin(theta) (l theta'^2 + g cos(theta)) - k x", 1),
      other_coordinate);
  EXPECT_EQ(fault("cart_pendulum", x + "\n" + theta, std::nullopt), none);
  EXPECT_EQ(fault("cart_pendulum", theta + "\n" + x, std::nullopt), none);
  EXPECT_EQ(
      fault("cart_pendulum",
            x + "\n2*x''*(M+m) + 2 m l theta'' cos(theta) = 2 m l theta'^2 sin(theta) - 2 k x", std::nullopt),
      dependent);
}

/// Every equation that the service prints is right, and wrong with any other number in front of a term.
TEST(SameMotion, KnowsTheEquationsOfEverySystem) {
  for (const std::string& name : practice_systems()) {
    const auto model = model_of(name);
    for (std::size_t i = 0; i < model->degrees_of_freedom(); ++i) {
      const Equation& equation = model->equations.equations[i];
      const std::string text = print_equation(equation.left, equation.right, Form::text);
      EXPECT_EQ(fault(name, text, i), none) << name << ": " << text;
      const std::string q = model->scene.coordinates[i].name;
      EXPECT_EQ(fault(name, text + " + " + q + "/1000", i), not_true) << name << ": " << text;
    }
  }
}

}  // namespace
}  // namespace qdot::test
