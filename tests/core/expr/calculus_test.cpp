// Derivatives against differences, substitution against evaluation.

#include "core/expr/calculus.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/expr/parse.hpp"
#include "core/expr/print/print.hpp"
#include "core/numerics/ball.hpp"
#include "tests/support/random_expression.hpp"
#include "tests/support/random_polynomial.hpp"

namespace qdot {
namespace {

const std::vector<std::string> names{"x", "y", "z", "t", "x_dot", "x_ddot", "y_dot"};

/// A central difference with its error: that of half the step tells it.
struct Slope {
  double value, error;
};

template <class F>
Slope slope(F f, double h) {
  const double coarse = (f(h) - f(-h)) / (2 * h);
  const double fine = (f(h / 2) - f(-h / 2)) / h;
  return {(4 * fine - coarse) / 3, std::abs(fine - coarse)};  // Richardson's extrapolation
}

TEST(Derivative, IsTheLimitOfDifferences) {
  test::Random random(17);
  test::Ingredients ingredients;
  ingredients.functions.pop_back();  // sign is no function to differentiate at its step
  ingredients.doubles = false;       // beside 1e24 a step is lost
  int compared = 0;
  for (int i = 0; i < 3000; ++i) {
    Graph graph;
    const Expression theta = graph.symbol("theta");
    const Expression e = test::random_expression(random, graph, 1 + i % 4, ingredients);
    std::vector<Assignment> values;
    for (const char* symbol : {"m", "g", "l", "phi", "theta_dot", "phi_ddot"})
      values.emplace_back(graph.symbol(symbol), random.real(0.1, 0.9));
    const double at = random.real(0.1, 0.9);
    const auto near = [&](double step) {
      std::vector<Assignment> shifted = values;
      shifted.emplace_back(theta, at + step);
      return evaluate(e, shifted);
    };
    const Slope expected = slope(near, 1e-3);
    const double size = 1 + std::abs(expected.value);
    if (!std::isfinite(near(0)) || !(std::abs(near(0)) < 1e6)) continue;
    if (!(expected.error < 1e-4 * size)) continue;  // a kink, a pole or a steep place nearby
    values.emplace_back(theta, at);
    const double found = evaluate(differentiate(e, theta), values);
    EXPECT_NEAR(found, expected.value, expected.error + 1e-9 * (size + std::abs(near(0))))
        << print(e, Form::text);
    compared += depends_on(e, theta) ? 1 : 0;
  }
  EXPECT_GT(compared, 600);
}

struct Derived {
  std::string function, derivative;
};

TEST(Derivative, OfEveryFunctionIsTheTextbooks) {
  Graph graph;
  for (const auto& [function, derivative] : std::vector<Derived>{{"sin(2*x)", "2*cos(2*x)"},
                                                                 {"cos(x)", "-sin(x)"},
                                                                 {"tan(x)", "1 + tan(x)^2"},
                                                                 {"asin(x)", "1/sqrt(1 - x^2)"},
                                                                 {"acos(x)", "-1/sqrt(1 - x^2)"},
                                                                 {"atan(x)", "1/(1 + x^2)"},
                                                                 {"sinh(x)", "cosh(x)"},
                                                                 {"cosh(x)", "sinh(x)"},
                                                                 {"tanh(x)", "1 - tanh(x)^2"},
                                                                 {"exp(-x)", "-exp(-x)"},
                                                                 {"log(x)", "1/x"},
                                                                 {"abs(x)", "sign(x)"},
                                                                 {"sign(x)", "0"},
                                                                 {"x^3*y", "3*x^2*y"},
                                                                 {"sqrt(x)", "1/(2*sqrt(x))"},
                                                                 {"y*z", "0"}}) {
    const Expression found = differentiate(parse(function, graph, names), graph.symbol("x"));
    EXPECT_EQ(found, parse(derivative, graph, names)) << function << " " << print(found, Form::text);
  }
}

TEST(TotalDerivative, FollowsTheMotion) {
  Graph graph;
  const auto read = [&](const std::string& text) { return parse(text, graph, names); };
  const std::vector<Replacement> rates{{read("x"), read("x_dot")},
                                       {read("y"), read("y_dot")},
                                       {read("x_dot"), read("x_ddot")},
                                       {read("t"), graph.number(1)}};
  EXPECT_EQ(total_derivative(read("x^2*y"), rates), read("2*x*x_dot*y + x^2*y_dot"));
  EXPECT_EQ(total_derivative(read("x_dot*sin(t)"), rates), read("x_ddot*sin(t) + x_dot*cos(t)"));
  EXPECT_EQ(total_derivative(read("z"), rates), graph.number(0));
}

TEST(Substitute, ReplacesAllSymbolsAtOnce) {
  Graph graph;
  const auto read = [&](const std::string& text) { return parse(text, graph, names); };
  const std::vector<Replacement> swap{{read("x"), read("y")}, {read("y"), read("x")}};
  EXPECT_EQ(substitute(read("x - 2*y"), swap), read("y - 2*x"));
  const std::vector<Replacement> zero{{read("x"), graph.number(0)}};
  EXPECT_EQ(substitute(read("x*y + cos(x) + z"), zero), read("1 + z"));
}

TEST(Substitute, OfNumbersIsEvaluation) {
  test::Random random(18);
  for (int i = 0; i < 300; ++i) {
    Graph graph;
    const Expression e = test::random_polynomial(random, graph, 5);
    const std::vector<Assignment> values = test::random_values(random, graph);
    std::vector<Replacement> numbers;
    for (const auto& [symbol, value] : values)
      numbers.emplace_back(symbol, graph.number(Number::real(value)));
    const double size = 1 + test::largest_part(e, values);
    EXPECT_NEAR(evaluate(substitute(e, numbers), {}), evaluate(e, values), 1e-13 * size)
        << print(e, Form::text);
  }
}

TEST(EvaluateExactly, KeepsWhatTheDoubleLeavesOut) {
  Graph graph;
  const auto value = [&](const std::string& text) {
    return Ball::literal(evaluate_exactly(parse(text, graph, names), {}));
  };
  // By mpmath, 40 digits, as high + low + rest.
  EXPECT_TRUE((value("pi/6") - Ball({0.5235987755982989, -5.360408832255455e-17}, 1e-32)).contains_zero());
  EXPECT_TRUE((value("sqrt(2)") - Ball({1.4142135623730951, -9.667293313452913e-17}, 1e-32)).contains_zero());
  EXPECT_TRUE((value("0.1") * Ball(10) - Ball(1)).contains_zero());
  EXPECT_LT(value("2*sqrt(9.81/0.4)").radius, 1e-29);
  EXPECT_EQ(evaluate_exactly(parse("3/4", graph, names), {}), Real(0.75));
  EXPECT_TRUE(std::isnan(evaluate_exactly(graph.symbol("x"), {}).value));
}

TEST(Evaluate, KnowsPiAndNoOtherName) {
  Graph graph;
  EXPECT_EQ(evaluate(parse("2*pi", graph, names), {}), 2 * std::numbers::pi);
  EXPECT_TRUE(std::isnan(evaluate(graph.symbol("x"), {})));
}

}  // namespace
}  // namespace qdot
