// Trigonometric identities: each way of writing keeps the value, and finds what is zero.

#include "core/expr/trigonometry.hpp"

#include <gtest/gtest.h>

#include "core/expr/parse.hpp"
#include "core/expr/print/print.hpp"
#include "tests/support/random_polynomial.hpp"

namespace qdot::trigonometry_test {
namespace {

const std::vector<std::string> names{"x", "y", "m", "l", "theta", "phi", "theta_dot"};

struct Rewriting {
  const char* name;
  Polynomial (*of)(Graph&, const Polynomial&);
};

const std::vector<Rewriting> rewritings{
    {"joined", [](Graph& graph, const Polynomial& p) { return joined(graph, p); }},
    {"joined after opening",
     [](Graph& graph, const Polynomial& p) { return joined(graph, with_single_angles(graph, p)); }},
    {"without_sine_squares",
     [](Graph& graph, const Polynomial& p) { return without_sine_squares(graph, p, graph.symbol("theta")); }},
    {"without_cosine_squares",
     [](Graph& graph, const Polynomial& p) {
       return without_cosine_squares(graph, p, graph.symbol("theta"));
     }},
    {"with_double_angle",
     [](Graph& graph, const Polynomial& p) { return with_double_angle(graph, p, graph.symbol("theta")); }},
    {"with_single_angles", with_single_angles}};

TEST(Rewriting, KeepsTheValue) {
  test::Random random(23);
  for (int i = 0; i < 200; ++i) {
    Graph graph;
    const Polynomial p = multiplied_out(test::random_polynomial(random, graph, 6));
    for (const Rewriting& rewriting : rewritings) {
      const Expression before = to_expression(graph, p), after = to_expression(graph, rewriting.of(graph, p));
      for (int k = 0; k < 4; ++k) {  // a wrong identity agrees at no random place
        const std::vector<Assignment> values = test::random_values(random, graph);
        const double size = 1 + test::largest_part(before, values) + test::largest_part(after, values);
        EXPECT_NEAR(evaluate(after, values), evaluate(before, values), 1e-13 * size)
            << rewriting.name << " of " << print(before, Form::text);
      }
    }
  }
}

struct Joined {
  std::string terms, one;
};

TEST(Joined, UsesTheIdentitiesOfTextbooks) {
  for (const auto& [terms, one] :
       std::vector<Joined>{{"sin(x)^2 + cos(x)^2", "1"},
                           {"m*l^2*sin(x)^2 + m*l^2*cos(x)^2", "m*l^2"},
                           {"1 - sin(x)^2", "cos(x)^2"},
                           {"l - l*cos(x)^2", "l*sin(x)^2"},
                           {"cos(x)*cos(y) + sin(x)*sin(y)", "cos(x - y)"},
                           {"cos(x)*cos(y) - sin(x)*sin(y)", "cos(x + y)"},
                           {"sin(x)*cos(y) - cos(x)*sin(y)", "sin(x - y)"},
                           {"2*m*sin(x)*cos(y) + 2*m*cos(x)*sin(y)", "2*m*sin(x + y)"},
                           {"cos(x)^2 - sin(x)^2", "cos(2*x)"},
                           {"sin(x)^4 + sin(x)^2*cos(x)^2", "sin(x)^2"},
                           {"sin(x)^2 + 2*cos(x)^2", "sin(x)^2 + 2*cos(x)^2"}}) {
    Graph graph;
    const auto read = [&](const std::string& text) { return parse(text, graph, names); };
    const Expression found = to_expression(graph, joined(graph, multiplied_out(read(terms))));
    EXPECT_EQ(found, read(one)) << terms << " became " << print(found, Form::text);
  }
}

TEST(SingleAngles, AreANormalForm) {
  for (const char* zero :
       {"sin(x + y) - sin(x)*cos(y) - cos(x)*sin(y)", "cos(3*x) - 4*cos(x)^3 + 3*cos(x)",
        "sin(2*x)*cos(2*x) - sin(4*x)/2", "sin(x)^2 + cos(x)^2 - 1", "cos(x - y)^2 + sin(x - y)^2 - 1",
        "sin(x - y) + sin(y - x)", "cos(x + y)*cos(x - y) - cos(x)^2 + sin(y)^2"}) {
    Graph graph;
    EXPECT_TRUE(with_single_angles(graph, multiplied_out(parse(zero, graph, names))).empty()) << zero;
  }
  Graph graph;
  EXPECT_FALSE(with_single_angles(graph, multiplied_out(parse("sin(x)^2 - cos(x)^2", graph, names))).empty());
}

TEST(TrigonometricQuotient, SeesThroughTheForms) {
  Graph graph;
  const auto polynomial = [&](const std::string& text) { return multiplied_out(parse(text, graph, names)); };
  const auto quotient = [&](const std::string& a, const std::string& b) {
    const auto found = trigonometric_quotient(graph, polynomial(a), polynomial(b));
    return found ? print(to_expression(graph, *found), Form::text) : "none";
  };
  EXPECT_EQ(quotient("x*sin(x)^2 + x", "1 + sin(x)^2"), "x");
  EXPECT_EQ(quotient("x*(2 - cos(x)^2)", "1 + sin(x)^2"), "x");
  EXPECT_EQ(quotient("sin(x)^2", "1 + cos(x)"), "1 - cos(x)");
  EXPECT_EQ(quotient("x", "1 + sin(x)"), "none");
}

TEST(TrigonometricArguments, AreThoseOfSinesAndCosines) {
  Graph graph;
  const Polynomial p = multiplied_out(parse("x*sin(theta) + cos(theta - phi)*exp(y)", graph, names));
  const std::vector<Expression> arguments = trigonometric_arguments(graph, p);
  EXPECT_EQ(arguments.size(), 2u);
  for (const char* text : {"theta", "theta - phi"})
    EXPECT_NE(std::find(arguments.begin(), arguments.end(), parse(text, graph, names)), arguments.end())
        << text;
}

}  // namespace
}  // namespace qdot::trigonometry_test
