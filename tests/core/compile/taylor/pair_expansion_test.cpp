// Two motions side by side have the bits that each has alone.

#include "core/compile/taylor/pair_expansion.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/compile/taylor/formula.hpp"
#include "tests/support/motions.hpp"
#include "tests/support/states.hpp"
#include "tests/support/system_test.hpp"

namespace qdot::expansion_test {
namespace {

constexpr unsigned highest = PairExpansion::highest_order;

/// f(t, q, q_dot) with parameters a and b.
CompiledFunction with_parameters(const std::string& formula) {
  Graph graph;
  const Expression t = graph.symbol("t");
  const std::vector<Expression> parameters{graph.symbol("a"), graph.symbol("b")};
  const std::vector<Expression> variables{graph.symbol("q"), graph.symbol("q_dot")};
  const std::vector<std::string> names{"a", "b", "t", "q", "q_dot"};
  TapeBuilder builder(graph, parameters, t, variables);
  builder.output(parse(formula, graph, names));
  return builder.finish();
}

/// One of two motions on a tape.
struct Motion {
  std::vector<double> parameters, y;
};

class Pair {
 public:
  Pair(const CompiledFunction& tape, const Motion& a, const Motion& b,
       InstructionSet set = InstructionSet::automatic)
      : motions_{a, b}, a_(tape, a.parameters, set), b_(tape, b.parameters, set), both_(a_, b_) {}

  [[nodiscard]] bool expand(unsigned order) {
    const std::size_t n = motions_[0].y.size();
    std::vector<PairOfDoubles> y(n);
    for (std::size_t i = 0; i < n; ++i) y[i] = PairOfDoubles{motions_[0].y[i], motions_[1].y[i]};
    found_.resize(n * (order + 1));
    return both_.expand(t, y, order, found_);
  }

  void expect_bits_of_each(unsigned order) {
    ASSERT_TRUE(expand(order));
    std::vector<double> first(found_.size()), second(found_.size());
    ASSERT_EQ(a_.expand(t, motions_[0].y, order, first), Evaluation::ok);
    ASSERT_EQ(b_.expand(t, motions_[1].y, order, second), Evaluation::ok);
    for (std::size_t i = 0; i < found_.size(); ++i) {
      EXPECT_EQ(found_[i][0], first[i]) << order << " " << i;
      EXPECT_EQ(found_[i][1], second[i]) << order << " " << i;
    }
  }

 private:
  static constexpr double t = 0.7;
  std::vector<Motion> motions_;
  TaylorExpansion a_, b_;
  PairExpansion both_;
  std::vector<PairOfDoubles> found_;
};

class PairOfFormulas : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Formulas, PairOfFormulas,
                         testing::Values("-a*sin(b*q)", "cos(q - a)*q_dot", "tan(a*q/2)", "tanh(a*q) + b",
                                         "tanh(20*a*q)", "asin(a*q/3)", "acos(q/3 - b*t/9)", "atan(a*q)",
                                         "sinh(a*q)", "b*cosh(q/2)", "exp(-a*q^2)", "log(2 + a*q)",
                                         "sqrt(1 + b*q^2)", "(1 + a*q^2)^(5/3)", "b/(2 + a*q)",
                                         "q^3 - a*q*q_dot/(1 + t)", "cos(a*t)*q",
                                         "exp(sin(b*q))/sqrt(2 + cos(t))", "(a - 2*cos(q))*q_dot",
                                         "(b + q - 3*q_dot)*(a - q*q_dot)*q", "abs(q)*q_dot*a",
                                         "abs(q_dot) - b*sign(q_dot)*t", "0", "a", "a*t"));

TEST_P(PairOfFormulas, HasTheBitsOfEach) {
  const CompiledFunction tape = with_parameters(GetParam());
  for (const InstructionSet set : {InstructionSet::automatic, InstructionSet::plain}) {
    Pair pair(tape, {{1.1, 0.6}, {0.4, -0.3}}, {{1.3, 0.7}, {-0.35, 0.25}}, set);
    for (unsigned order = 1; order <= highest; ++order) pair.expect_bits_of_each(order);
  }
}

TEST(PairExpansion, LeavesOneAloneWhereASumIsZeroInTheOther) {
  const CompiledFunction tape = with_parameters("(a - b + 2*q)*q_dot");
  EXPECT_FALSE(Pair(tape, {{1, 1}, {0.4, -0.3}}, {{1, 1.5}, {0.4, -0.3}}).expand(8));
  EXPECT_TRUE(Pair(tape, {{1, 1.25}, {0.4, -0.3}}, {{1, 1.5}, {0.4, -0.3}}).expand(8));
}

TEST(PairExpansion, LeavesOneAloneThatHasReachedALimit) {
  const CompiledFunction tape = with_parameters("exp(-a*q^2) + b");
  EXPECT_FALSE(Pair(tape, {{1, 0}, {1, 0}}, {{1, 0}, {50, 0}}).expand(8));
  EXPECT_FALSE(Pair(tape, {{1, 0}, {50, 0}}, {{1, 0}, {1, 0}}).expand(8));
}

TEST(PairExpansion, SaysWhereOneOfBothHasNoValue) {
  const CompiledFunction tape = with_parameters("a*log(q)");
  EXPECT_FALSE(Pair(tape, {{1, 0}, {1, 0}}, {{1, 0}, {-1, 0}}).expand(8));
  EXPECT_FALSE(Pair(tape, {{1, 0}, {-1, 0}}, {{1, 0}, {1, 0}}).expand(8));
  EXPECT_FALSE(Pair(tape, {{1, 0}, {1, 0}}, {{1, 0}, {2, 0}}).expand(highest + 1));
}

class PairOfSystems : public test::SystemTest {};
INSTANTIATE_TEST_SUITE_P(Systems, PairOfSystems, testing::ValuesIn(test::all_systems()), test::system_name);

TEST_P(PairOfSystems, HasTheBitsOfEach) {
  const Dynamics dynamics(test::model_of(GetParam()));
  test::Random random(12);
  for (int i = 0; i < 10; ++i) {
    const auto motion = [&] {
      const Values state = test::random_state(model(), random);
      return Motion{test::parameters_in(model(), state), test::motion_in(model(), state)};
    };
    const Motion a = motion(), b = motion();
    for (const InstructionSet set : {InstructionSet::automatic, InstructionSet::plain}) {
      Pair pair(dynamics.accelerations(), a, b, set);
      for (const unsigned order : {1U, 7U, 8U, 9U, 14U, highest}) pair.expect_bits_of_each(order);
    }
  }
}

}  // namespace
}  // namespace qdot::expansion_test
