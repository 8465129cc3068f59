// A tape of divided differences encloses the quotients of what the tape of numbers gives.

#include "core/compile/tape_evaluator.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/compile/tape_builder.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/print/print.hpp"
#include "core/numerics/divided_difference.hpp"
#include "core/numerics/taylor_enclosure.hpp"
#include "tests/support/random_expression.hpp"

namespace qdot::tape_evaluator_test {
namespace {

/// A random expression of one variable as a tape.
CompiledFunction tape_of(Graph& graph, const Expression& e, const Expression& x) {
  const std::vector<Expression> parameters{graph.symbol("m"), graph.symbol("g"), graph.symbol("l")};
  TapeBuilder builder(graph, parameters, graph.symbol("t"), {&x, 1});
  builder.output(e);
  return builder.finish();
}

TEST(TapeEvaluator, DividedDifferencesOfRandomExpressionsAreTheQuotientsOfTheirValues) {
  test::Random random(34);
  test::Ingredients ingredients;
  ingredients.functions = {Function::sin, Function::cos, Function::atan, Function::tanh, Function::exp};
  int compared = 0;
  for (int i = 0; i < 3000; ++i) {
    Graph graph;
    const Expression x = graph.symbol("theta");
    Expression e = test::random_expression(random, graph, 1 + i % 4, ingredients);
    const Replacement others[]{{graph.symbol("phi"), x * x},
                               {graph.symbol("theta_dot"), graph.number(2)},
                               {graph.symbol("phi_ddot"), sin(x)}};
    e = substitute(e, others);
    const CompiledFunction tape = tape_of(graph, e, x);
    const std::vector<double> constants{random.real(0.5, 2), random.real(0.5, 2), random.real(0.5, 2)};
    std::vector<DividedDifference> unchanging;
    for (const double c : constants) unchanging.push_back(DividedDifference::constant(c));
    TapeEvaluator<DividedDifference> enclosed(tape, unchanging);
    const double a = random.real(-2, 2), b = random.real(-2, 2);
    const DividedDifference place = DividedDifference::variable(a, b);
    DividedDifference found;
    enclosed({&place, 1}, {&found, 1});
    Workspace workspace = tape.bind(constants);
    double at_a{}, at_b{};
    if (tape.evaluate(0, {&a, 1}, workspace, {&at_a, 1}) != Evaluation::ok ||
        tape.evaluate(0, {&b, 1}, workspace, {&at_b, 1}) != Evaluation::ok || !found.slope.is_finite() ||
        found.at_a.magnitude() > 1e6 || found.at_b.magnitude() > 1e6) {
      continue;
    }
    // The values' own enclosures bound what rounding may have done to them.
    const Interval quotient = (found.at_b - found.at_a) / (Interval(b) - Interval(a));
    EXPECT_TRUE(found.at_a.contains(at_a) && found.at_b.contains(at_b)) << print(e, Form::text);
    EXPECT_FALSE(is_empty(intersection(quotient, found.slope))) << print(e, Form::text);
    ++compared;
  }
  EXPECT_GT(compared, 1500);
}

TEST(TapeEvaluator, AnArithmeticWithoutLinearSystemsKnowsNothingOfTheirSolutions) {
  Graph graph;
  const Expression x = graph.symbol("x"), zero = graph.number(0), one = graph.number(1);
  const std::vector<Expression> unknowns{graph.symbol("u"), graph.symbol("v")};
  TapeBuilder builder(graph, {}, graph.symbol("t"), {&x, 1});
  builder.solve({.matrix = {{one + x * x, x}, {x, graph.number(3)}},
                 .determinant = {},
                 .right_hand_sides = {{one, x}},
                 .unknowns = unknowns});
  builder.output(unknowns[0] + zero);
  const CompiledFunction tape = builder.finish();
  TapeEvaluator<FineSeries> evaluator(tape, {});
  const FineSeries place = FineSeries::variable(Ball(0.5), Interval(0.25, 0.75));
  FineSeries found;
  evaluator({&place, 1}, {&found, 1});
  for (const Interval& coefficient : found.over) EXPECT_FALSE(coefficient.is_finite());
  EXPECT_FALSE(std::isfinite(found.at[0].magnitude()));
}

}  // namespace
}  // namespace qdot::tape_evaluator_test
