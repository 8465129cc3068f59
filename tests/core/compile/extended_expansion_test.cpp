// Taylor coefficients in double-doubles: they solve the equation to thirty digits, with the same bits on
// every processor.

#include "core/compile/extended/expansion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/compile/tape_builder.hpp"
#include "core/expr/parse.hpp"

namespace qdot {
namespace {

constexpr unsigned order = ExtendedExpansion::highest_order;

/// q'' = a(t, q, q') for a formula in t, q, q_dot and the parameter c.
CompiledFunction acceleration(const std::string& formula) {
  Graph graph;
  const Expression t = graph.symbol("t");
  const std::vector<Expression> parameters{graph.symbol("c")};
  const std::vector<Expression> variables{graph.symbol("q"), graph.symbol("q_dot")};
  const std::vector<std::string> names{"t", "c", "q", "q_dot"};
  TapeBuilder builder(graph, parameters, t, variables);
  builder.output(parse(formula, graph, names));
  return builder.finish();
}

/// M(q) q'' = f(q, q') for three coordinates that the matrix couples, and no determinant.
CompiledFunction coupled_accelerations() {
  Graph graph;
  const Expression t = graph.symbol("t");
  const std::vector<std::string> names{"a", "b", "c", "u", "v", "w"};
  std::vector<Expression> variables, unknowns;
  for (const std::string& name : names) variables.push_back(graph.symbol(name));
  for (const char* name : {"x", "y", "z"}) unknowns.push_back(graph.symbol(name));
  const auto row = [&](std::initializer_list<const char*> texts) {
    std::vector<Expression> result;
    for (const char* text : texts) result.push_back(parse(text, graph, names));
    return result;
  };
  TapeBuilder builder(graph, {}, t, variables);
  const auto solution = builder.solve(
      {{row({"3", "cos(a - b)", "cos(a)"}), row({"cos(a - b)", "2", "b/4"}), row({"cos(a)", "b/4", "2"})},
       std::nullopt,
       {row({"-sin(a)", "u*v - sin(b)", "-c*w"})},
       unknowns});
  for (const Slot slot : solution[0]) builder.output(slot);
  return builder.finish();
}

DoubleDouble value_at(std::span<const DoubleDouble> c, std::size_t i, const DoubleDouble& s) {
  DoubleDouble sum;
  for (unsigned k = order + 1; k-- > 0;) sum = sum * s + c[i * (order + 1) + k];
  return sum;
}

DoubleDouble slope_at(std::span<const DoubleDouble> c, std::size_t i, const DoubleDouble& s) {
  DoubleDouble sum;
  for (unsigned k = order; k >= 1; --k) sum = sum * s + DoubleDouble(k) * c[i * (order + 1) + k];
  return sum;
}

void expect_the_equation_to_hold(const CompiledFunction& tape, std::span<const DoubleDouble> parameters,
                                 const std::vector<DoubleDouble>& y) {
  const DoubleDouble t{0.7, 1.1e-17};
  const std::size_t n = y.size() / 2;
  ExtendedExpansion expansion(tape, parameters);
  std::vector<DoubleDouble> c(2 * n * (order + 1));
  ASSERT_EQ(expansion.expand(t, y, order, c), Evaluation::ok);
  ExtendedTape direct(tape, parameters);
  for (const double s : {-0.05, 0.02, 0.05}) {
    std::vector<DoubleDouble> state, a(n);
    for (std::size_t i = 0; i < 2 * n; ++i) state.push_back(value_at(c, i, s));
    ASSERT_EQ(direct.evaluate(t + DoubleDouble(s), state, a), Evaluation::ok);
    for (std::size_t i = 0; i < n; ++i) {
      const DoubleDouble defect = slope_at(c, n + i, s) - a[i];
      EXPECT_LE(std::abs(defect.high), 2e-29 * (1 + std::abs(a[i].high))) << s;
      EXPECT_LE(std::abs((slope_at(c, i, s) - state[n + i]).high), 2e-30) << s;
    }
  }
}

class ExtendedRecurrence : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Formulas, ExtendedRecurrence,
                         testing::Values("-sin(q)", "cos(q)*q_dot", "tan(q/2)", "asin(q/3)", "acos(q/3)",
                                         "atan(q)", "sinh(q)", "cosh(q/2)", "tanh(q)", "exp(-q^2)",
                                         "log(2 + q)", "sqrt(1 + q^2)", "(1 + q^2)^(5/3)", "1/(2 + q)",
                                         "q^3 - q*q_dot/(1 + t)", "cos(3*t)*q", "c*sin(c*q)/(c + t)",
                                         "exp(sin(q))/sqrt(2 + cos(t))", "q^7", "(1 - 2*cos(q))*q_dot",
                                         "sin(q - 2*t)*(3 + t)", "(q + q_dot/3)*sin(q)", "0", "2", "t",
                                         "sin(c)*q", "c^(1/3)/(q + 3)"));

TEST_P(ExtendedRecurrence, SolvesTheEquationToThirtyDigits) {
  const DoubleDouble c = DoubleDouble(1) / DoubleDouble(3);
  expect_the_equation_to_hold(acceleration(GetParam()), {&c, 1}, {{0.4, 1e-17}, {-0.3, 1.3e-17}});
}

TEST_P(ExtendedRecurrence, HasTheSameBitsWithAndWithoutFusedMultiplyAdds) {
  const CompiledFunction tape = acceleration(GetParam());
  const DoubleDouble c = DoubleDouble(1) / DoubleDouble(3);
  ExtendedExpansion fast(tape, {&c, 1}), plain(tape, {&c, 1}, InstructionSet::plain);
  for (const double size : {1.0, 1e-3, 1e-150}) {
    const std::vector<DoubleDouble> y{{0.4, 1e-17}, {-0.3 * size, 1.3e-17 * size}};
    std::vector<DoubleDouble> one(2 * (order + 1)), other(2 * (order + 1));
    ASSERT_EQ(fast.expand(0.7, y, order, one), Evaluation::ok);
    ASSERT_EQ(plain.expand(0.7, y, order, other), Evaluation::ok);
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(one[i].high, other[i].high) << i;
      EXPECT_EQ(one[i].low, other[i].low) << i;
    }
  }
}

/// As many bits as doubles have agree with the expansion in doubles, and the first coefficients have the
/// rest.
TEST_P(ExtendedRecurrence, InMixedFormHasTheFirstCoefficientsWhole) {
  const CompiledFunction tape = acceleration(GetParam());
  const DoubleDouble c = DoubleDouble(1) / DoubleDouble(3);
  constexpr unsigned mixed_order = 20;
  ExtendedExpansion full(tape, {&c, 1});
  MixedExpansion mixed(tape, {&c, 1});
  const std::vector<DoubleDouble> y{{0.4, 1e-17}, {-0.3, 1.3e-17}};
  std::vector<DoubleDouble> whole(2 * (mixed_order + 1)), part(whole.size());
  ASSERT_EQ(full.expand(0.7, y, mixed_order, whole), Evaluation::ok);
  ASSERT_EQ(mixed.expand(0.7, y, mixed_order, part), Evaluation::ok);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const double size = std::abs(whole[i].high) + std::pow(2.0, static_cast<double>(i % (mixed_order + 1)));
    const double allowed = i % (mixed_order + 1) < MixedExpansion::first_in_doubles ? 0 : 1e-13 * size;
    EXPECT_LE(std::abs((whole[i] - part[i]).high), allowed) << i;
  }
}

TEST(ExtendedExpansion, SolvesCoupledEquationsToThirtyDigits) {
  expect_the_equation_to_hold(coupled_accelerations(), {},
                              {{0.4, 1e-17}, 0.3, -0.2, {-0.3, 1.3e-17}, 0.5, {0.1, 1e-18}});
}

void expect_the_same_bits_by_another_clock(const CompiledFunction& tape,
                                           std::span<const DoubleDouble> parameters,
                                           std::vector<DoubleDouble> y) {
  const double u = 0x1p-7;
  const DoubleDouble t{0.7, 1.1e-17};
  const CompiledFunction by_clock = tape.in_unit_of_time(u);
  std::vector<DoubleDouble> c(y.size() * (order + 1)), other(c.size());
  ASSERT_EQ(ExtendedExpansion(tape, parameters).expand(t, y, order, c), Evaluation::ok);
  for (std::size_t i = y.size() / 2; i < y.size(); ++i) y[i] = scaled(y[i], -7);
  ASSERT_EQ(ExtendedExpansion(by_clock, parameters).expand(scaled(t, 7), y, order, other), Evaluation::ok);
  for (std::size_t i = 0; i < c.size(); ++i) {
    const int power = static_cast<int>(i % (order + 1)) + (i < c.size() / 2 ? 0 : 1);
    const DoubleDouble expected = scaled(c[i], -7 * power);
    EXPECT_EQ(other[i].high, expected.high) << i;
    EXPECT_EQ(other[i].low, expected.low) << i;
  }
}

TEST_P(ExtendedRecurrence, HasTheSameBitsByAnotherClock) {
  const DoubleDouble c = DoubleDouble(1) / DoubleDouble(3);
  expect_the_same_bits_by_another_clock(acceleration(GetParam()), {&c, 1}, {{0.4, 1e-17}, {-0.3, 1.3e-17}});
}

TEST(ExtendedExpansion, HasTheSameBitsByAnotherClockWhereEquationsAreCoupled) {
  expect_the_same_bits_by_another_clock(coupled_accelerations(), {},
                                        {{0.4, 1e-17}, 0.3, -0.2, {-0.3, 1.3e-17}, 0.5, {0.1, 1e-18}});
}

TEST(ExtendedExpansion, SaysWhereThereIsNoValue) {
  std::vector<DoubleDouble> c(2 * (order + 1));
  const std::vector<DoubleDouble> y{0.0, 1.0};
  const DoubleDouble parameter = 1.0;
  const CompiledFunction inverse = acceleration("1/q");
  EXPECT_EQ(ExtendedExpansion(inverse, {&parameter, 1}).expand(0.0, y, order, c), Evaluation::nonfinite);
  const CompiledFunction root = acceleration("sqrt(q - 1)");
  EXPECT_EQ(ExtendedExpansion(root, {&parameter, 1}).expand(0.0, y, order, c), Evaluation::nonfinite);
}

TEST(ExtendedTape, FollowsTheTapeOfDoubles) {
  const CompiledFunction tape = acceleration("sin(q)*c + t/(1 + q_dot^2) - sqrt(2 + q)");
  const double c = 0.37, t = 1.3, q = 0.4, q_dot = -0.7;
  Workspace workspace = tape.bind({&c, 1});
  double expected{};
  ASSERT_EQ(tape.evaluate(t, std::vector{q, q_dot}, workspace, {&expected, 1}), Evaluation::ok);
  const DoubleDouble parameter = c;
  DoubleDouble value;
  const std::vector<DoubleDouble> y{q, q_dot};
  ASSERT_EQ(ExtendedTape(tape, {&parameter, 1}).evaluate(t, y, {&value, 1}), Evaluation::ok);
  EXPECT_NEAR(value.high, expected, 1e-15);
}

}  // namespace
}  // namespace qdot
