// Canonical forms: equal expressions are the same node, whatever way they were built.

#include "core/expr/expression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/parse.hpp"
#include "core/expr/print/print.hpp"
#include "tests/support/random_expression.hpp"

namespace qdot::expression_test {
namespace {

const std::vector<std::string> names{"a", "b", "c", "x", "y", "z", "theta", "phi"};

struct Pair {
  std::string one, other;
};

void PrintTo(const Pair& pair, std::ostream* out) { *out << pair.one << " and " << pair.other; }

class EqualExpressions : public testing::TestWithParam<Pair> {};
INSTANTIATE_TEST_SUITE_P(
    Table, EqualExpressions,
    testing::Values(Pair{"x + y", "y + x"}, Pair{"(x + y) + z", "x + (y + z)"}, Pair{"x*(y*z)", "(z*x)*y"},
                    Pair{"x + x", "2*x"}, Pair{"3*x*y - y*x", "2*x*y"}, Pair{"x - x", "0"},
                    Pair{"3*(x + y) - 2*(x + y)", "x + y"}, Pair{"-(x - y)", "y - x"}, Pair{"x*x^2", "x^3"},
                    Pair{"x/x", "1"}, Pair{"x^2/x^3", "1/x"}, Pair{"sqrt(x)*sqrt(x)", "x"},
                    Pair{"(x*y)^2", "x^2*y^2"}, Pair{"(x^2)^3", "x^6"}, Pair{"(2*x)^3", "8*x^3"},
                    Pair{"sqrt(2)*sqrt(2)", "2"}, Pair{"x^0", "1"}, Pair{"0*x", "0"},
                    Pair{"1/2 + 1/3", "5/6"}, Pair{"2^10", "1024"}, Pair{"0.1 + 0.2", "0.3"},
                    Pair{"sin(-x)", "-sin(x)"}, Pair{"cos(-x)", "cos(x)"},
                    Pair{"sin(theta - phi)", "-sin(phi - theta)"},
                    Pair{"cos(theta - phi)", "cos(phi - theta)"}, Pair{"sin(-2*x)", "-sin(2*x)"},
                    Pair{"tan(-x)", "-tan(x)"}, Pair{"abs(-x)", "abs(x)"}, Pair{"cosh(-x)", "cosh(x)"},
                    Pair{"sign(-x)", "-sign(x)"}, Pair{"sin(0)", "0"}, Pair{"cos(0)", "1"},
                    Pair{"exp(0)", "1"}, Pair{"log(1)", "0"}, Pair{"x^y", "exp(y*log(x))"}));

TEST_P(EqualExpressions, AreTheSameNode) {
  Graph graph;
  const Expression one = parse(GetParam().one, graph, names), other = parse(GetParam().other, graph, names);
  EXPECT_TRUE(one == other) << print(one, Form::text) << " and " << print(other, Form::text);
}

/// What is equal only under conditions or by an identity is left alone.
class DistinctExpressions : public testing::TestWithParam<Pair> {};
INSTANTIATE_TEST_SUITE_P(Table, DistinctExpressions,
                         testing::Values(Pair{"x", "y"}, Pair{"sqrt(x^2)", "x"},
                                         Pair{"sqrt(x*y)", "sqrt(x)*sqrt(y)"},
                                         Pair{"(x + y)^2", "x^2 + 2*x*y + y^2"},
                                         Pair{"sin(x)^2 + cos(x)^2", "1"}, Pair{"exp(-x)", "exp(x)"},
                                         Pair{"acos(-x)", "acos(x)"}, Pair{"acos(-x)", "-acos(x)"},
                                         Pair{"log(exp(x))", "x"}, Pair{"x*(y + z)", "x*y + x*z"}));

TEST_P(DistinctExpressions, AreDifferentNodes) {
  Graph graph;
  EXPECT_NE(parse(GetParam().one, graph, names), parse(GetParam().other, graph, names));
}

TEST(Expression, IsAFlatSumOrProduct) {
  Graph graph;
  const Expression sum = parse("x + (y + (z + a))", graph, names);
  EXPECT_EQ(std::get<Sum>(sum.node()).terms.size(), 4u);
  const Expression product = parse("2*x*(3*y*(z/a))", graph, names);
  EXPECT_EQ(std::get<Product>(product.node()).factors.size(), 4u);
  EXPECT_EQ(std::get<Product>(product.node()).coefficient, Number(6));
}

TEST(Expression, HasChildrenOlderThanItself) {
  test::Random random(15);
  Graph graph;
  for (int i = 0; i < 200; ++i) (void)test::random_expression(random, graph, 4);
  for (NodeId id = 0; id < graph.size(); ++id) {
    for (const NodeId child : children(graph.node(id))) EXPECT_LT(child, id);
  }
}

TEST(Expression, BuiltAgainMakesNoNodes) {
  Graph graph;
  for (int round = 0; round < 2; ++round) {
    test::Random random(16);
    const std::size_t before = graph.size();
    for (int i = 0; i < 100; ++i) {
      (void)test::random_expression(random, graph, 4, {.doubles = false});
    }
    EXPECT_EQ(round == 0, graph.size() > before);
  }
}

TEST(Expression, DependsOnWhatItContains) {
  Graph graph;
  const Expression e = parse("sin(x)^2/y", graph, names);
  EXPECT_TRUE(depends_on(e, graph.symbol("x")));
  EXPECT_TRUE(depends_on(e, graph.symbol("y")));
  EXPECT_FALSE(depends_on(e, graph.symbol("z")));
  EXPECT_FALSE(depends_on(parse("x - x", graph, names), graph.symbol("x")));
}

TEST(Expression, SplitsIntoCoefficientAndRest) {
  Graph graph;
  const Scaled scaled = split_coefficient(parse("-3/4*x*y", graph, names));
  EXPECT_EQ(scaled.coefficient, Number::ratio(-3, 4));
  EXPECT_EQ(scaled.rest, parse("x*y", graph, names));
  const Raised raised = split_power(parse("x^(2/3)", graph, names));
  EXPECT_EQ(raised.base, graph.symbol("x"));
  EXPECT_EQ(raised.exponent, Number::ratio(2, 3));
}

TEST(Graph, CopiedKeepsItsNumbersAndGrowsAlone) {
  Graph graph;
  const Expression e = parse("x*sin(y) + 1", graph, names);
  Graph copy = graph;
  EXPECT_EQ(print(copy.adopt(e), Form::text), print(e, Form::text));
  const std::size_t size = graph.size();
  (void)copy.symbol("new in the copy");
  EXPECT_EQ(graph.size(), size);
  EXPECT_EQ(copy.size(), size + 1);
}

TEST(Graph, StopsAtItsBound) {
  Graph graph;
  try {
    for (std::size_t i = 0; i <= Graph::max_nodes; ++i)
      (void)graph.number(Number(static_cast<std::int64_t>(i)));
    FAIL() << "grew past its bound";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::too_large);
  }
  EXPECT_EQ(graph.size(), Graph::max_nodes);
}

}  // namespace
}  // namespace qdot::expression_test
