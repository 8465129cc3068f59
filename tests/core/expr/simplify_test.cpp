// Short forms: the same values, written as one writes them by hand.

#include "core/expr/simplify.hpp"

#include <gtest/gtest.h>

#include "core/expr/bracket_memory.hpp"
#include "core/expr/factored_form.hpp"
#include "core/expr/linear.hpp"
#include "core/expr/parse.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/print/print.hpp"
#include "tests/support/operation_count.hpp"
#include "tests/support/random_expression.hpp"
#include "tests/support/random_polynomial.hpp"

namespace qdot::simplify_test {
namespace {

const Notation notation{{"m", "k", "l0", "g", "mu"}, {"l", "x", "theta", "phi"}, {}};
/// In the order in which a scene declares them.
const std::vector<std::string> names{"l", "x", "theta", "phi", "l_dot", "theta_dot", "phi_dot",
                                     "m", "k", "l0",    "g",   "mu",    "a",         "b"};

TEST(Simplify, KeepsTheValue) {
  test::Random random(28);
  for (int i = 0; i < 60; ++i) {
    Graph graph;
    const Expression e = test::random_polynomial(random, graph, 4);
    const Expression simple = simplify(e);
    for (int k = 0; k < 20; ++k) {
      const std::vector<Assignment> values = test::random_values(random, graph);
      const double size = 1 + test::largest_part(e, values) + test::largest_part(simple, values);
      EXPECT_NEAR(evaluate(simple, values), evaluate(e, values), 1e-12 * size) << print(e, Form::text) << "\n"
                                                                               << print(simple, Form::text);
    }
  }
}

TEST(Simplify, IsTheSameAgainAndInACopyOfTheGraph) {
  test::Random random(27);
  for (int i = 0; i < 50; ++i) {
    Graph graph;
    const Expression e = test::random_polynomial(random, graph, 6);
    Graph other = graph;
    const Expression simple = simplify(e);
    EXPECT_EQ(simplify(e), simple);
    EXPECT_EQ(print(simplify(other.adopt(e)), Form::text), print(simple, Form::text));
    Graph copy = graph;
    EXPECT_EQ(simplify(copy.adopt(e)), copy.adopt(simple));
  }
}

TEST(FactoredForm, IsTheSameWithoutWhatTheGraphRemembers) {
  test::Random random(28);
  for (int i = 0; i < 50; ++i) {
    Graph graph;
    for (int k = 0; k < 4; ++k) {
      const Polynomial p = multiplied_out(test::random_polynomial(random, graph, 6));
      if (p.empty()) continue;
      const Expression form = factored_form(graph, p);
      EXPECT_EQ(factored_form(graph, p), form);
      graph.forget_brackets();
      EXPECT_EQ(factored_form(graph, p), form);
    }
  }
}

TEST(BracketMemory, KnowsAPolynomialOnlyAtItsLevel) {
  Graph graph;
  const Polynomial p = multiplied_out(parse("x*l + x*m + g/2", graph, names));
  BracketMemory memory;
  memory.keep(BracketMemory::key(2, p), graph.symbol("x").id());
  EXPECT_EQ(memory.form_of(BracketMemory::key(2, p)), graph.symbol("x").id());
  EXPECT_FALSE(memory.form_of(BracketMemory::key(1, p)));
  EXPECT_FALSE(memory.form_of(BracketMemory::key(2, scaled(p, {}, Number(2)))));
  EXPECT_FALSE(memory.form_of(BracketMemory::key(2, multiplied_out(parse("x*l + x*m", graph, names)))));
}

TEST(BracketMemory, StaysBehindWhenAGraphIsCopied) {
  Graph graph;
  const Polynomial p = multiplied_out(parse("x*l + x*m", graph, names));
  const BracketMemory::Key key = BracketMemory::key(1, p);
  graph.brackets().keep(key, graph.symbol("x").id());
  Graph copy = graph;
  EXPECT_FALSE(copy.brackets().form_of(key));
  copy.brackets().keep(key, copy.symbol("m").id());
  EXPECT_EQ(graph.brackets().form_of(key), graph.symbol("x").id());
}

TEST(Simplify, LeavesNoBracketWithAMinusInAllTerms) {
  Graph graph;
  const Expression e = simplify(parse("k*(x - l)*(-1/m - 1/g)", graph, names));
  EXPECT_EQ(print(e, Form::text, notation), "k*(1/m + 1/g)*(l - x)");
  const Expression springs = simplify(parse("-k*(x^2 + l^2)/2 - m*(x - l)^2/2", graph, names));
  EXPECT_EQ(print(springs, Form::text, notation), "-1/2*(m*(x - l)^2 + k*(l^2 + x^2))");
  const Polynomial sum = multiplied_out(parse("-m*x*l_dot - k*x*l_dot + theta_dot*x", graph, names));
  const std::vector<Expression> rates{graph.symbol("l_dot"), graph.symbol("theta_dot")};
  EXPECT_EQ(print(collected_form(graph, sum, rates), Form::text, notation), "x*(theta_dot - (m + k)*l_dot)");
}

TEST(Simplify, TakesOutAMinusBeforeASquare) {
  Graph graph;
  const Expression e = simplify(parse("k*(2*l*l0 - l0^2 - l^2)/2", graph, names));
  EXPECT_EQ(print(e, Form::text, notation), "-1/2*k*(l - l0)^2");
}

TEST(Simplify, DoesNotLengthenASumOfProducts) {
  test::Random random(25);
  for (int i = 0; i < 60; ++i) {
    Graph graph;
    const Expression e = expand(test::random_polynomial(random, graph, 4));
    EXPECT_LE(written_length(simplify(e)), written_length(e)) << print(e, Form::text);
  }
}

TEST(Simplify, DoesNotChangeWhatIsSimple) {
  test::Random random(29);
  for (int i = 0; i < 60; ++i) {
    Graph graph;
    const Expression simple = simplify(test::random_polynomial(random, graph, 4));
    EXPECT_EQ(print(simplify(simple), Form::text), print(simple, Form::text));
  }
}

struct Case {
  std::string given, simple;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.given; }

class SimplifiedForm : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    Table, SimplifiedForm,
    testing::Values(Case{"sin(theta)^2 + cos(theta)^2", "1"},
                    Case{"cos(theta)*cos(phi) + sin(theta)*sin(phi)", "cos(theta - phi)"},
                    Case{"m*l^2/4 + m*l^2*sin(theta) + m*l^2*sin(theta)^2", "m*l^2*(1/2 + sin(theta))^2"},
                    Case{"k*l - k*l0", "k*(l - l0)"}, Case{"k*l^2/2 - k*l*l0 + k*l0^2/2", "1/2*k*(l - l0)^2"},
                    Case{"l_dot^2*cos(theta)^2 + l_dot^2*sin(theta)^2 + l^2*theta_dot^2",
                         "l_dot^2 + l^2*theta_dot^2"},
                    Case{"(l_dot*sin(theta) + l*theta_dot*cos(theta))^2 + "
                         "(l*theta_dot*sin(theta) - l_dot*cos(theta))^2",
                         "l_dot^2 + l^2*theta_dot^2"},
                    Case{"m*g*l*cos(theta) + m*g*l*cos(phi)", "m*g*l*(cos(theta) + cos(phi))"},
                    Case{"3/2*m*g*l*cos(theta) + m*g*l*cos(phi)", "m*g*l*(3/2*cos(theta) + cos(phi))"},
                    Case{"sin(theta)*cos(theta)", "sin(theta)*cos(theta)"},
                    Case{"(a + b)*(a - b) + b^2", "a^2"}, Case{"m*(x + 1) - m*x", "m"},
                    Case{"sin(theta - phi)*cos(phi) + cos(theta - phi)*sin(phi)", "sin(theta)"},
                    Case{"1 + mu - mu*cos(phi)^2", "1 + mu*sin(phi)^2"},
                    Case{"tan(theta)*cos(theta)", "sin(theta)"}, Case{"x - x", "0"}));

TEST_P(SimplifiedForm, IsAsOneWritesItByHand) {
  Graph graph;
  for (const std::string& name : names) (void)graph.symbol(name);  // signs go by the order of declaration
  const std::string found = print(simplify(parse(GetParam().given, graph, names)), Form::text, notation);
  EXPECT_EQ(found, GetParam().simple);
}

TEST(SimplifyQuotient, CancelsWhatBothShare) {
  Graph graph;
  const auto read = [&](const std::string& text) { return parse(text, graph, names); };
  const auto quotient = [&](const std::string& a, const std::string& b) {
    return print(simplify_quotient(read(a), read(b)), Form::text, notation);
  };
  EXPECT_EQ(quotient("m*l^2*x", "m*l"), "l*x");
  EXPECT_EQ(quotient("x^2 - 1", "x + 1"), "x - 1");
  EXPECT_EQ(quotient("m*(1 - cos(theta)^2)", "m^2*sin(theta)"), "sin(theta)/m");
  EXPECT_EQ(quotient("0", "x"), "0");
  EXPECT_EQ(quotient("x", "m + mu*m*sin(phi)^2"), "x/(m*(1 + mu*sin(phi)^2))");
  EXPECT_EQ(quotient("g - g*l0/k", "3*x*(k - l0) + m*(k - l0)*cos(phi)"), "g/(k*(3*x + m*cos(phi)))");
}

TEST(OperationCount, IsThatOfTheWrittenForm) {
  test::Random random(27);
  for (int i = 0; i < 500; ++i) {
    Graph graph;
    const Expression e = test::random_polynomial(random, graph, 4);
    EXPECT_EQ(graph.length(e.id()).operations, test::operation_count_of_text(print(e, Form::text)))
        << print(e, Form::text);
  }
}

TEST(WrittenLength, CountsFractionsHalf) {
  Graph graph;
  const auto length = [&](const std::string& text) { return written_length(parse(text, graph, names)); };
  EXPECT_EQ(length("x"), 0u);
  EXPECT_EQ(length("2*x"), 2u);
  EXPECT_EQ(length("x/2"), 3u);
  EXPECT_EQ(length("m*(x + 1)"), 4u);
}

TEST(Cramer, SolvesWrittenSystems) {
  Graph graph;
  const auto read = [&](const std::string& text) { return parse(text, graph, names); };
  const Matrix m{{read("m"), read("k")}, {read("k"), read("g")}};
  EXPECT_EQ(determinant(m), read("m*g - k^2"));
  const std::vector<Expression> x = cramer(m, {read("a"), read("b")});
  const std::vector<Assignment> values{
      {read("m"), 2}, {read("k"), 3}, {read("g"), 7}, {read("a"), 5}, {read("b"), 11}};  // determinant 5
  EXPECT_DOUBLE_EQ(evaluate(x[0], values), (5 * 7 - 3 * 11) / 5.0);
  EXPECT_DOUBLE_EQ(evaluate(x[1], values), (2 * 11 - 3 * 5) / 5.0);
}

TEST(Determinant, OfThreeRowsIsSarrusRule) {
  Graph graph;
  const auto number = [&](int n) { return graph.number(Number(n)); };
  const Matrix m{{number(2), number(-1), number(3)},
                 {number(0), number(4), number(5)},
                 {number(1), number(7), number(6)}};
  EXPECT_EQ(determinant(m), number(2 * (24 - 35) + 1 * (0 - 5) + 3 * (0 - 4)));
}

}  // namespace
}  // namespace qdot::simplify_test
