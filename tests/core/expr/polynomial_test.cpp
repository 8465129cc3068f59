// Multiplied-out expressions: values stay, products divide again, squares have roots.

#include "core/expr/polynomial.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/expr/parse.hpp"
#include "core/expr/print/print.hpp"
#include "core/expr/simplify.hpp"
#include "tests/support/random_polynomial.hpp"

namespace qdot::polynomial_test {
namespace {

const std::vector<std::string> names{"x", "y", "z"};

class PolynomialIn : public testing::Test {
 protected:
  Expression read(const std::string& text) { return parse(text, graph_, names); }
  Polynomial polynomial(const std::string& text) { return multiplied_out(read(text)); }
  std::string expanded(const std::string& text) { return print(expand(read(text)), Form::text); }

  Graph graph_;
};

TEST_F(PolynomialIn, IsASumOfProducts) {
  EXPECT_EQ(expanded("(x + y)^2"), "x^2 + y^2 + 2*x*y");
  EXPECT_EQ(expanded("(x + y)*(x - y)"), "x^2 - y^2");
  EXPECT_EQ(expanded("x*(y + z)/x"), "y + z");
  EXPECT_EQ(expanded("(x + y)/(2*z)"), "x/(2*z) + y/(2*z)");
  EXPECT_EQ(expanded("sqrt(x + y)*sqrt(x + y)"), "x + y");
  EXPECT_EQ(expanded("sin(x*(y + z) - x*y)"), "sin(x*z)");
  EXPECT_EQ(expanded("(x + y)^3 - x^3 - 3*x^2*y - 3*x*y^2 - y^3"), "0");
}

TEST_F(PolynomialIn, OfAPolynomialIsItself) {
  test::Random random(19);
  for (int i = 0; i < 200; ++i) {
    const Polynomial p = multiplied_out(test::random_polynomial(random, graph_, 6));
    EXPECT_EQ(multiplied_out(to_expression(graph_, p)), p);
  }
}

TEST(Expand, KeepsTheValue) {
  test::Random random(20);
  for (int i = 0; i < 200; ++i) {
    Graph graph;
    const Expression e = test::random_polynomial(random, graph, 4) *
                         test::random_polynomial(random, graph, 4) /
                         (graph.number(5) + pow(graph.symbol("m"), Number(2)));
    const Expression expanded = expand(e);
    for (int k = 0; k < 20; ++k) {
      const std::vector<Assignment> values = test::random_values(random, graph);
      const double size = 1 + test::largest_part(e, values) + test::largest_part(expanded, values);
      EXPECT_NEAR(evaluate(expanded, values), evaluate(e, values), 1e-13 * size) << print(e, Form::text);
    }
  }
}

TEST(ExactQuotient, OfAProductIsTheOtherFactor) {
  test::Random random(21);
  for (int i = 0; i < 300; ++i) {
    Graph graph;
    const Polynomial a = multiplied_out(test::random_polynomial(random, graph, 4));
    const Polynomial b = multiplied_out(test::random_polynomial(random, graph, 3));
    if (a.empty() || b.empty()) continue;
    const auto quotient = exact_quotient(a * b, b);
    ASSERT_TRUE(quotient.has_value());
    EXPECT_EQ(*quotient, a);
  }
}

TEST_F(PolynomialIn, IsNotDividedWhereARestWouldBeLeft) {
  EXPECT_FALSE(exact_quotient(polynomial("x^2 + y^2"), polynomial("x + y")).has_value());
  EXPECT_FALSE(exact_quotient(polynomial("x^2 - y^2 + 1"), polynomial("x - y")).has_value());
  EXPECT_FALSE(exact_quotient(polynomial("x"), polynomial("x + y")).has_value());
  EXPECT_TRUE(exact_quotient(polynomial("x^2 - y^2"), polynomial("x - y")).has_value());
}

TEST_F(PolynomialIn, IsDividedWhateverTheExponentsAre) {
  const auto quotient = [&](const std::string& a, const std::string& b) {
    return exact_quotient(polynomial(a), polynomial(b));
  };
  EXPECT_EQ(quotient("x - y", "sqrt(x) - sqrt(y)"), polynomial("sqrt(x) + sqrt(y)"));
  EXPECT_EQ(quotient("(x + 1/y)*(1/x + y)", "1/x + y"), polynomial("x + 1/y"));
  EXPECT_EQ(quotient("x^2/y + x^3", "x/y^2"), polynomial("x*y + x^2*y^2"));
  EXPECT_EQ(quotient("0", "x + y"), Polynomial{});
  EXPECT_FALSE(quotient("sqrt(x) + y", "x + y").has_value());
  EXPECT_FALSE(quotient("x/y + 1", "x/y + y").has_value());
}

TEST(ExactRoot, OfASquareIsWhatWasSquared) {
  test::Random random(22);
  int squares = 0;
  for (int i = 0; i < 300; ++i) {
    Graph graph;
    const Polynomial a = multiplied_out(test::random_polynomial(random, graph, 4));
    if (a.empty()) continue;
    const auto root = exact_root(a * a);
    ASSERT_TRUE(root.has_value()) << print(to_expression(graph, a), Form::text);
    EXPECT_EQ(*root, a.begin()->second.is_negative() ? scaled(a, {}, Number(-1)) : a);
    ++squares;
  }
  EXPECT_GT(squares, 250);
}

TEST_F(PolynomialIn, HasNoRootWhereItIsNoSquare) {
  for (const char* text : {"x^2 + y^2", "x^2 + 2*x*y + 2*y^2", "2*x^2", "x^3", "x^2 + x*y + y^2", "-x^2"})
    EXPECT_FALSE(exact_root(polynomial(text)).has_value()) << text;
  EXPECT_EQ(exact_root(polynomial("x^2 + x*y + y^2/4")), polynomial("x + y/2"));
}

TEST_F(PolynomialIn, SharesTheMonomialOfAllItsTerms) {
  const auto common = [&](const std::string& text) {
    return print(to_expression(graph_, common_monomial(polynomial(text))), Form::text);
  };
  EXPECT_EQ(common("x^2*y + x^3"), "x^2");
  EXPECT_EQ(common("x/z + y/z^2"), "1/z");
  EXPECT_EQ(common("x + y"), "1");
  EXPECT_EQ(common("x*z + y/z"), "1");  // z above and below: nothing to take out
}

TEST_F(PolynomialIn, MultipliesAsNumbersDo) {
  const Polynomial a = polynomial("x + 2*y"), b = polynomial("x - z"), c = polynomial("y^2 + 1/x");
  EXPECT_EQ(a * b, b * a);
  EXPECT_EQ((a * b) * c, a * (b * c));
  Polynomial sum = b;
  add(sum, c);
  Polynomial parts = a * b;
  add(parts, a * c);
  EXPECT_EQ(a * sum, parts);
}

TEST_F(PolynomialIn, InvertsItsMonomials) {
  const Monomial m = polynomial("x^2*y/z").begin()->first;
  EXPECT_TRUE((m * inverse(m)).empty());
  EXPECT_EQ(exponent_of(m, read("x").id()), 2);
  EXPECT_EQ(exponent_of(m, read("z").id()), -1);
  EXPECT_EQ(exponent_of(times(m, read("y").id(), -1), read("y").id()), 0);
}

TEST_F(PolynomialIn, RefusesToGrowWithoutBound) {
  try {
    (void)multiplied_out(read("(x + y + z + 1)^30"));
    FAIL() << "multiplied out";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::too_large);
  }
}

/// Exponents whose common denominator leaves the range of an int.
TEST_F(PolynomialIn, KeepsTheValueOfStrangeRoots) {
  const Expression e =
      read("(x^(1/61) + 1)*(x^(1/59) + 1)*(x^(1/53) + 1)*(x^(1/47) + 1)*(x^(1/43) + 1)*(x^(1/41) + 1)");
  const std::vector<Assignment> values{{read("x"), 1.7}};
  try {
    EXPECT_NEAR(evaluate(expand(e), values), evaluate(e, values), 1e-11);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::too_large);
  }
}

TEST(Expand, CountsItsWork) {
  Graph graph;
  const Expression product =
      parse("(a + b + c + d)^3*(a - b + c - d)^3", graph, std::vector<std::string>{"a", "b", "c", "d"});
  const auto is_enough = [&](std::uint64_t units) {
    const WorkScope scope(units);
    try {
      (void)expand(product);
      return true;
    } catch (const Error&) {
      return false;
    }
  };
  EXPECT_FALSE(is_enough(400));
  EXPECT_TRUE(is_enough(40'000));
}

}  // namespace
}  // namespace qdot::polynomial_test
