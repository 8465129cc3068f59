// Quotients in lowest terms and roots of quadratics: values stay, common factors go, forms are short.

#include "core/expr/surd.hpp"

#include <gtest/gtest.h>

#include "core/expr/calculus.hpp"
#include "core/expr/parse.hpp"
#include "core/expr/polynomial_gcd.hpp"
#include "core/expr/print/print.hpp"
#include "tests/support/random_polynomial.hpp"

namespace qdot::surd_test {
namespace {

const std::vector<std::string> names{"x", "y", "z", "g", "l", "m"};

class Algebra : public testing::Test {
 protected:
  Expression read(const std::string& text) { return parse(text, graph_, names); }
  Polynomial polynomial(const std::string& text) { return multiplied_out(read(text)); }
  RationalFunction quotient(const std::string& text) { return rational_function(read(text)); }
  std::string written(const Expression& e) { return print(e, Form::text, {names, {}, {}}); }
  std::string divisor(const std::string& a, const std::string& b) {
    return written(to_expression(graph_, greatest_common_divisor(polynomial(a), polynomial(b))));
  }
  std::string lowest(const std::string& text) { return written(to_expression(graph_, quotient(text))); }
  std::vector<std::string> roots(const std::string& a, const std::string& b, const std::string& c) {
    std::vector<std::string> found;
    for (const Surd& root : quadratic_roots(quotient(a), quotient(b), quotient(c)))
      found.push_back(written(to_expression(graph_, root)));
    return found;
  }
  std::string root_of(const std::string& text) {
    return written(positive_root(graph_, quotient(text), [](const Polynomial&) { return 1; }));
  }

  Graph graph_;
};

TEST_F(Algebra, FindsTheFactorsThatPolynomialsShare) {
  EXPECT_EQ(divisor("(x + y)*(x - z)", "(x + y)^2*(y + z)"), "x + y");
  EXPECT_EQ(divisor("x^2 - y^2", "x^2 + y^2"), "1");
  EXPECT_EQ(divisor("6*(x + 1)*(y + 2)", "4*(y + 2)*(x - 1)*z + 4*(y + 2)"), "2 + y");
  EXPECT_EQ(divisor("x*(y + z)", "y^2 - z^2"), "y + z");
}

TEST_F(Algebra, DividesProductsByTheirFactorsAgain) {
  test::Random random(7);
  for (int i = 0; i < 60; ++i) {
    const Polynomial a = multiplied_out(test::random_polynomial(random, graph_, 3));
    const Polynomial b = multiplied_out(test::random_polynomial(random, graph_, 3));
    const Polynomial c = multiplied_out(test::random_polynomial(random, graph_, 2));
    if (a.empty() || b.empty() || c.empty()) continue;
    const Polynomial common = greatest_common_divisor(a * c, b * c);
    EXPECT_TRUE(exact_quotient(a * c, common).has_value());
    EXPECT_TRUE(exact_quotient(b * c, common).has_value());
    EXPECT_TRUE(exact_quotient(common, greatest_common_divisor(c, c)).has_value());
  }
}

TEST_F(Algebra, BringsQuotientsToLowestTerms) {
  EXPECT_EQ(lowest("(x^2 - y^2)/(x - y)"), "x + y");
  EXPECT_EQ(lowest("1/(1/x + 1/y)"), "x*y/(x + y)");
  EXPECT_EQ(lowest("g/(l + m*g/x) - 1/(1 + 1/(1 + 1/z))*0"), "x*g/(x*l + g*m)");
  EXPECT_EQ(lowest("(g*l - l^2*x^2)/l^2"), "g/l - x^2");
  EXPECT_EQ(lowest("x/y - x/y"), "0");
  EXPECT_EQ(quotient("2*x/(4*y - 4*z)"), quotient("-x/(2*z - 2*y)"));
}

TEST_F(Algebra, SolvesQuadraticsAsTextbooksWriteThem) {
  const std::vector<std::string> of_the_rod{"(17 - sqrt(217))*g/(4*l)", "(17 + sqrt(217))*g/(4*l)"};
  EXPECT_EQ(roots("l^2", "-17/2*g*l", "9/2*g^2"), of_the_rod);
  EXPECT_EQ(roots("l^2", "-5/2*g*l", "g^2"), (std::vector<std::string>{"g/(2*l)", "2*g/l"}));
  EXPECT_EQ(roots("1", "-2*(x + y)", "(x + y)^2 - z*x^2"),
            (std::vector<std::string>{"x + y - x*sqrt(z)", "x + y + x*sqrt(z)"}));
  EXPECT_EQ(roots("0", "x", "y"), (std::vector<std::string>{"-y/x"}));
  EXPECT_TRUE(roots("0", "0", "y").empty());
}

TEST_F(Algebra, TakesSquaresOutOfRoots) {
  EXPECT_EQ(root_of("g/(2*l)"), "sqrt(g/(2*l))");
  EXPECT_EQ(root_of("4*g/l"), "2*sqrt(g/l)");
  EXPECT_EQ(root_of("x^2*g/l"), "x*sqrt(g/l)");
  EXPECT_EQ(root_of("(x + y)^2*z"), "sqrt(z)*(x + y)");
  EXPECT_EQ(root_of("8*x^3"), "2*x*sqrt(2*x)");
}

TEST_F(Algebra, OfSurdsKeepsTheirValues) {
  test::Random random(11);
  const std::vector<Assignment> values{{read("x"), 0.7}, {read("y"), 1.3}, {read("z"), 2.1}};
  const Surd a(quotient("x/y"), quotient("1/z"), polynomial("x + 2*y"));
  const Surd b(quotient("y - z"), quotient("x*y"), polynomial("x + 2*y"));
  const auto value = [&](const Surd& s) { return evaluate(to_expression(graph_, s), values); };
  EXPECT_NEAR(value(a + b), value(a) + value(b), 1e-13);
  EXPECT_NEAR(value(a - b), value(a) - value(b), 1e-13);
  EXPECT_NEAR(value(a * b), value(a) * value(b), 1e-13);
  EXPECT_NEAR(value(a / b), value(a) / value(b), 1e-13);
}

}  // namespace
}  // namespace qdot::surd_test
