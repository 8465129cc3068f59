#include "core/grading/same_formula.hpp"

#include <gtest/gtest.h>

#include "core/grading/student_parser.hpp"
#include "tests/support/scenes.hpp"

namespace qdot::test {
namespace {

/// The decision on `submitted` where `expected` is asked for, of one system.
FormulaVerdict verdict(const std::string& system, const std::string& expected, const std::string& submitted,
                       std::uint64_t seed = 1) {
  const auto model = model_of(system);
  const ExpectedSystem of(*model);
  Vocabulary vocabulary(of.symbols(), of.momenta());
  const auto read = [&](const std::string& text) {
    const ReadSubmission read = read_submission(text, of.graph(), vocabulary);
    EXPECT_TRUE(read.errors.empty()) << text << ": " << read.errors.front();
    return read.equations.front().left;
  };
  const auto named = of.quantity(expected);
  return compare_formulas(of, named ? expected : "", read(submitted), named ? *named : read(expected), seed);
}

Decision decision(const std::string& expected, const std::string& submitted) {
  return verdict("spring_pendulum", expected, submitted).decision;
}

constexpr auto identity = Decision::identity, values = Decision::values, wrong = Decision::counterexample,
               unknown = Decision::unknown;

TEST(SameFormula, HoldsInEveryForm) {
  EXPECT_EQ(decision("T", "m/2 (l'^2 + l^2 theta'^2)"), identity);
  EXPECT_EQ(
      decision("T", "m/2 ((l' sin theta + l theta' cos theta)^2 + (l' cos theta - l theta' sin theta)^2)"),
      identity);
  EXPECT_EQ(decision("T", "m/2 (l'^2 + l^2 theta'^2) + 1e-30 m"), wrong);
  EXPECT_EQ(decision("T", "m/2 (l'^2 + l^2 theta'^2) (1 + 1e-40 l)"), wrong);
  EXPECT_EQ(decision("T", "m/2 (l'^2 - l^2 theta'^2)"), wrong);
  EXPECT_EQ(decision("tan(theta)", "sin(2*theta)/(1 + cos(2*theta))"), identity);
  EXPECT_EQ(decision("sin(theta/2)^2", "(1 - cos(theta))/2"), values);
  EXPECT_EQ(decision("sin(theta/2)^2", "(1 - cos(theta))/2 + 1e-12"), wrong);
  EXPECT_EQ(decision("1/(1 + tan(theta)^2)", "cos(theta)^2"), identity);
  EXPECT_EQ(decision("1/(l + 1/l)", "l/(l^2 + 1)"), identity);
  EXPECT_EQ(decision("sqrt(k/m)", "sqrt(k m)/m"), values);
  EXPECT_EQ(decision("sqrt(g/l)", "sqrt(l/g)"), wrong);
}

TEST(SameFormula, EnergiesAreFreeUpToAConstant) {
  const FormulaVerdict free = verdict("spring_pendulum", "V", "m g l (1 - cos(theta)) + 1/2 k (l - l0)^2");
  EXPECT_EQ(free.decision, wrong);  // m g l is no constant: l changes
  const FormulaVerdict cart = verdict("cart_pendulum", "V", "m g l (1 - cos(theta)) + k x^2/2");
  EXPECT_EQ(cart.decision, identity);
  EXPECT_TRUE(cart.differs_by_constant);
  const FormulaVerdict half = verdict("cart_pendulum", "V", "2 m g l sin(theta/2)^2 + k x^2/2");
  EXPECT_EQ(half.decision, values);
  EXPECT_TRUE(half.differs_by_constant);
  EXPECT_EQ(verdict("cart_pendulum", "V", "2 m g l sin(theta/2)^2 + k x^2").decision, wrong);
  EXPECT_EQ(
      verdict("cart_pendulum", "T", "(M+m)/2 x'^2 + m l x' theta' cos(theta) + m l^2 theta'^2/2 + m g l")
          .decision,
      wrong);
}

TEST(SameFormula, ReactionsMayBeWrittenWithAccelerations) {
  EXPECT_EQ(verdict("orbiting_pendulum", "tension", "m (l (omega0 + phi')^2 + r omega0^2 cos(phi))").decision,
            identity);
  EXPECT_EQ(verdict("cart_pendulum", "theta_ddot", "-(g sin(theta) + x'' cos(theta))/l").decision, identity);
  EXPECT_EQ(verdict("cart_pendulum", "theta_ddot", "-(g sin(theta) - x'' cos(theta))/l").decision, wrong);
}

/// Formulas that agree with the right one wherever a careless comparison looks.
TEST(SameFormula, WhatCannotBeSeenIsNoEvidence) {
  EXPECT_EQ(decision("theta", "theta + exp(-1000000*(theta - 0.7)^2)"), wrong);
  EXPECT_EQ(decision("sin(theta/2)^2", "(1 - cos(theta))/2 + exp(-1000*(theta - 50)^2)"), unknown);
  EXPECT_EQ(decision("theta", "theta + l*(1 - tanh(1000*(theta + 50)))"), unknown);
  EXPECT_EQ(decision("theta", "theta + abs(theta - 1000) + theta - 1000"), unknown);
  EXPECT_EQ(decision("theta", "asin(sin(theta))"), wrong);
  EXPECT_EQ(decision("theta", "abs(theta)"), wrong);
  EXPECT_EQ(decision("l", "abs(l)"), values);
  EXPECT_EQ(decision("l", "sqrt(l^2)"), values);
  EXPECT_EQ(decision("theta", "sqrt(theta^2)"), wrong);
  EXPECT_EQ(decision("theta", "theta + sqrt(-1 - l)"), unknown);
  EXPECT_EQ(decision("cos(theta)", "sin(theta + pi/2)"), values);
}

TEST(SameFormula, HasTheSameVerdictForEverySeed) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    EXPECT_EQ(verdict("rod_spring_pendulum", "r_ddot",
                      "r phi'^2 - l(theta'' sin(phi-theta) - theta'^2 cos(phi-theta))"
                      " + g cos(phi) - k(r-l0)/m",
                      seed)
                  .decision,
              identity);
    EXPECT_EQ(verdict("rod_spring_pendulum", "r_ddot",
                      "r phi'^2 - l(theta'' sin(phi-theta) + theta'^2 cos(phi-theta))"
                      " + g cos(phi) - k(r-l0)/m",
                      seed)
                  .decision,
              wrong);
  }
}

}  // namespace
}  // namespace qdot::test
