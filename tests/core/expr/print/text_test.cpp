// The text form reads back as the same expression, and reads like a textbook.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/expr/parse.hpp"
#include "core/expr/print/print.hpp"
#include "tests/support/operation_count.hpp"
#include "tests/support/random_expression.hpp"

namespace qdot::text_test {
namespace {

const Notation pendulum{
    {"M", "m", "k", "l0", "g", "r", "Omega", "mu", "gamma", "F"}, {"x", "l", "theta", "phi"}, {}};

const std::vector<std::string> names{
    "M",      "m",         "k",       "l0",     "g",          "r",     "Omega",  "mu", "gamma",
    "F",      "x",         "l",       "theta",  "phi",        "x_dot", "l_dot",  "b",  "t",
    "x_ddot", "theta_dot", "phi_dot", "l_ddot", "theta_ddot", "q_dot", "p_theta"};

std::string reprinted(const std::string& text, const Notation& notation = pendulum) {
  Graph graph;
  return print(parse(text, graph, names), Form::text, notation);
}

/// Products of random numbers become numbers that no double is near, which parse refuses.
bool is_beyond_doubles(const ParseResult& result) {
  return !result.errors.empty() &&
         result.errors[0].message.find("outside the range of a double") != std::string::npos;
}

TEST(PrintText, ReadsBackAsTheSameExpression) {
  test::Random random(20240501);
  const test::Ingredients ingredients;
  std::set<std::string> seen;
  for (int i = 0; i < 4000; ++i) {
    Graph graph;
    const Expression e = test::random_expression(random, graph, 1 + i % 5, ingredients);
    const Notation notation = i % 2 == 0 ? Notation{} : pendulum;
    const std::string text = print(e, Form::text, notation);
    const ParseResult result = parse_all(
        text, graph, ingredients.symbols,
        {.bytes = 1 << 20, .tokens = 1 << 20, .depth = 1000, .exponent = 1 << 20, .nodes = 1 << 20});
    if (is_beyond_doubles(result)) continue;
    ASSERT_TRUE(result.expression.has_value()) << text << ": " << result.errors[0].message;
    ASSERT_EQ(*result.expression, e) << text << " reads as "
                                     << print(*result.expression, Form::text, notation);
    seen.insert(text);
  }
  EXPECT_GT(seen.size(), 3000u);  // the law is not shown on the same few expressions
}

TEST(PrintText, DoesNotDependOnTheHistoryOfTheGraph) {
  test::Random random(7);
  test::Ingredients ingredients;
  ingredients.functions = {Function::exp, Function::log,
                           Function::acos};  // no signs that depend on the order
  for (int i = 0; i < 1000; ++i) {
    Graph graph;
    const std::string text =
        print(test::random_expression(random, graph, 1 + i % 4, ingredients), Form::text, pendulum);
    Graph backwards;
    for (auto name = ingredients.symbols.rbegin(); name != ingredients.symbols.rend(); ++name) {
      (void)backwards.symbol(*name);
    }
    const ParseResult result =
        parse_all(text, backwards, ingredients.symbols,
                  {.bytes = 1 << 20, .tokens = 1 << 20, .depth = 1000, .exponent = 1 << 20});
    if (is_beyond_doubles(result)) continue;
    ASSERT_TRUE(result.expression.has_value()) << text;
    ASSERT_EQ(print(*result.expression, Form::text, pendulum), text);
  }
}

TEST(PrintText, KeepsEveryDouble) {
  test::Random random(3);
  Graph graph;
  const auto check = [&](double value) {
    const Expression e = graph.number(Number::real(value)) * graph.symbol("x");
    const std::string text = print(e, Form::text);
    EXPECT_EQ(parse(text, graph, names), e) << text;
  };
  for (int i = 0; i < 2000; ++i) {
    const auto exponent = static_cast<int>(random.integer(-300, 300));
    check(random.real(-1, 1) * std::pow(10.0, exponent));
    check(static_cast<double>(random.integer(1, 99999)) / 1000);
    check(static_cast<double>(random.integer(1, 9)) * std::pow(10.0, exponent / 10));
  }
  check(0.1);
  check(0.5);
  check(std::numeric_limits<double>::max());
  check(std::numeric_limits<double>::min());
  check(std::numeric_limits<double>::denorm_min());
}

TEST(PrintText, FactorsStandInTextbookOrder) {
  EXPECT_EQ(reprinted("sin(theta)*l*g*m"), "m*g*l*sin(theta)");
  EXPECT_EQ(reprinted("(l - l0)*k"), "k*(l - l0)");
  EXPECT_EQ(reprinted("theta_ddot*l^2*m"), "m*l^2*theta_ddot");
  EXPECT_EQ(reprinted("theta_ddot*theta_dot*theta"), "theta*theta_dot*theta_ddot");
  EXPECT_EQ(reprinted("x_ddot*(M + m)"), "(M + m)*x_ddot");
  EXPECT_EQ(reprinted("sqrt(2)*m*pi*r*2"), "2*sqrt(2)*pi*m*r");
  EXPECT_EQ(reprinted("sin(Omega*t)*m"), "m*sin(Omega*t)");
  EXPECT_EQ(reprinted("cos(theta)*sin(theta)"), "sin(theta)*cos(theta)");
}

TEST(PrintText, TermsStandByFallingDerivatives) {
  EXPECT_EQ(reprinted("m*g*l*sin(theta) + 2*m*l*l_dot*theta_dot + m*l^2*theta_ddot"),
            "m*l^2*theta_ddot + 2*m*l*l_dot*theta_dot + m*g*l*sin(theta)");
  EXPECT_EQ(reprinted("k*(l - l0) - m*g*cos(theta) - m*l*theta_dot^2 + m*l_ddot"),
            "m*l_ddot - m*l*theta_dot^2 + k*(l - l0) - m*g*cos(theta)");
  EXPECT_EQ(reprinted("1/2*m*l^2*(2*theta_dot*phi_dot*cos(theta - phi) + phi_dot^2 + theta_dot^2)"),
            "1/2*m*l^2*(theta_dot^2 + phi_dot^2 + 2*theta_dot*phi_dot*cos(theta - phi))");
  EXPECT_EQ(reprinted("p_theta^2/(2*m*l^2) - m*g*l*cos(theta)"), "p_theta^2/(2*m*l^2) - m*g*l*cos(theta)");
  EXPECT_EQ(reprinted("k*x + m*l*theta_ddot*cos(theta) - m*l*theta_dot^2*sin(theta) + (M + m)*x_ddot"),
            "(M + m)*x_ddot + m*l*theta_ddot*cos(theta) - m*l*theta_dot^2*sin(theta) + k*x");
  EXPECT_EQ(reprinted("l*(theta_ddot*cos(theta) - theta_dot^2*sin(theta)) + x_ddot"),
            "x_ddot + l*(theta_ddot*cos(theta) - theta_dot^2*sin(theta))");
}

TEST(PrintText, TermsThatVaryStandBeforeTermsThatDoNot) {
  EXPECT_EQ(reprinted("m*g/k + l"), "l + m*g/k");
  EXPECT_EQ(reprinted("theta - gamma - phi"), "theta - phi - gamma");
  EXPECT_EQ(reprinted("1/2*m*r^2*Omega^2 + 1/2*m*Omega^2*x^2"), "1/2*m*Omega^2*x^2 + 1/2*m*r^2*Omega^2");
  EXPECT_EQ(reprinted("m*sin(phi)^2 + M"), "M + m*sin(phi)^2");
}

TEST(PrintText, ShortTermsStandBeforeLongOnes) {
  EXPECT_EQ(reprinted("m*x*l + g*x"), "g*x + m*x*l");
  EXPECT_EQ(reprinted("x_dot*theta_dot^2 + x_dot^2*theta_dot"), "x_dot^2*theta_dot + x_dot*theta_dot^2");
  EXPECT_EQ(reprinted("x^3*l + x*l^2"), "x*l^2 + x^3*l");
  EXPECT_EQ(reprinted("(1 + x + x^2)*(1 + x)"), "(1 + x)*(1 + x + x^2)");
  EXPECT_EQ(reprinted("(1 + x)*(1 + x + x^2)"), "(1 + x)*(1 + x + x^2)");
}

TEST(PrintText, SumsAvoidALeadingMinus) {
  EXPECT_EQ(reprinted("1 - cos(phi)"), "1 - cos(phi)");
  EXPECT_EQ(reprinted("cos(phi) - 1"), "cos(phi) - 1");
  EXPECT_EQ(reprinted("-l0 + l"), "l - l0");
  EXPECT_EQ(reprinted("g - x_ddot"), "g - x_ddot");
  EXPECT_EQ(reprinted("-x - 1"), "-1 - x");
  EXPECT_EQ(reprinted("m + M"), "M + m");
  EXPECT_EQ(reprinted("sin(theta) + 1/2"), "1/2 + sin(theta)");
  EXPECT_EQ(reprinted("l*sin(theta) + x"), "x + l*sin(theta)");
}

TEST(PrintText, NegativePowersMakeOneQuotient) {
  EXPECT_EQ(reprinted("g*l^-1"), "g/l");
  EXPECT_EQ(reprinted("b^2*m^-1*l^-2/2"), "b^2/(2*m*l^2)");
  EXPECT_EQ(reprinted("3*b/(4*m)"), "3*b/(4*m)");
  EXPECT_EQ(reprinted("k/m*(l - l0)"), "k*(l - l0)/m");
  EXPECT_EQ(reprinted("1/m"), "1/m");
  EXPECT_EQ(reprinted("-1/(2*m)"), "-1/(2*m)");
  EXPECT_EQ(reprinted("1/(1 + mu*sin(phi)^2)"), "1/(1 + mu*sin(phi)^2)");
  EXPECT_EQ(reprinted("9.81*m/l"), "9.81*m/l");
  EXPECT_EQ(reprinted("1/sqrt(l)"), "1/sqrt(l)");
  EXPECT_EQ(reprinted("m/(l*sqrt(g))"), "m/(sqrt(g)*l)");
}

TEST(PrintText, FractionsStayInFrontWithoutAQuotient) {
  EXPECT_EQ(reprinted("3*m*q_dot^2/4"), "3/4*m*q_dot^2");
  EXPECT_EQ(reprinted("x/2"), "1/2*x");
  EXPECT_EQ(reprinted("-x/2"), "-1/2*x");
  EXPECT_EQ(reprinted("53/6*x"), "53/6*x");
  EXPECT_EQ(reprinted("x - 3/4"), "x - 3/4");
}

TEST(PrintText, DecimalsAreUsedWhereTheyAreShorter) {
  EXPECT_EQ(reprinted("981/100"), "9.81");
  EXPECT_EQ(reprinted("0.001*x"), "0.001*x");
  EXPECT_EQ(reprinted("0.75"), "3/4");
  EXPECT_EQ(reprinted("0.15"), "3/20");
  EXPECT_EQ(reprinted("0.0625"), "1/16");
  EXPECT_EQ(reprinted("0.200310900544247"), "0.200310900544247");
  EXPECT_EQ(reprinted("1/300"), "1/300");
}

TEST(PrintText, BracketsAreWrittenOnlyWhereNeeded) {
  EXPECT_EQ(reprinted("((x))^2"), "x^2");
  EXPECT_EQ(reprinted("(x + l)^2"), "(x + l)^2");
  EXPECT_EQ(reprinted("x^(1/3)"), "x^(1/3)");
  EXPECT_EQ(reprinted("x^-(1/3)"), "1/x^(1/3)");
  EXPECT_EQ(reprinted("sqrt(x)^3"), "x^(3/2)");
  EXPECT_EQ(reprinted("(-2)^(1/3)"), "(-2)^(1/3)");
  EXPECT_EQ(reprinted("(2/3)^(1/3)"), "(2/3)^(1/3)");
  EXPECT_EQ(reprinted("sqrt(2/3)"), "sqrt(2/3)");
  EXPECT_EQ(reprinted("sqrt(x^2)"), "sqrt(x^2)");
  EXPECT_EQ(reprinted("(x^2)^(1/3)"), "(x^2)^(1/3)");
  EXPECT_EQ(reprinted("x - 2*(l + theta)"), "x - 2*(l + theta)");
  EXPECT_EQ(reprinted("-(x - 1)*(l - 2)"), "-(x - 1)*(l - 2)");
  EXPECT_EQ(reprinted("sin(theta)^2"), "sin(theta)^2");
}

TEST(PrintText, WithoutANotationNamesDecide) {
  EXPECT_EQ(reprinted("sin(theta)*l*g*m", {}), "g*l*m*sin(theta)");
  EXPECT_EQ(reprinted("m*g*l*sin(theta) + m*theta_ddot*l^2", {}), "l^2*m*theta_ddot + g*l*m*sin(theta)");
}

TEST(PrintText, ExponentiallyLongFormsAreRefused) {
  Graph graph;
  Expression f = graph.symbol("x");
  for (int i = 0; i < 40; ++i) f = f * sin(f);
  for (const Form form : {Form::text, Form::latex, Form::mathml, Form::c}) {
    try {
      (void)print(f, form);
      ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::too_large);
    }
  }
}

TEST(OperationCountOfText, CountsWhatAReaderCounts) {
  EXPECT_EQ(test::operation_count_of_text("m*g*l*sin(theta)"), 4u);
  EXPECT_EQ(test::operation_count_of_text("1/2*m*l^2"), 3u);
  EXPECT_EQ(test::operation_count_of_text("-x"), 0u);
  EXPECT_EQ(test::operation_count_of_text("x - -y"), 1u);
  EXPECT_EQ(test::operation_count_of_text("x^(1/2)"), 1u);
  EXPECT_EQ(test::operation_count_of_text("x^-2"), 1u);
  EXPECT_EQ(test::operation_count_of_text("x**2"), 1u);
  EXPECT_EQ(test::operation_count_of_text("x/3/4"), 2u);
  EXPECT_EQ(test::operation_count_of_text("3/4^2"), 2u);
  EXPECT_EQ(test::operation_count_of_text("b^2/(2*m*l^2)"), 5u);
  EXPECT_EQ(test::operation_count_of_text("53/3"), 0u);
  EXPECT_EQ(test::operation_count_of_text("theta"), 0u);
}

}  // namespace
}  // namespace qdot::text_test
