// What makes formulas short: roots joined or split, factors and squares found, cosines for roots of
// polynomials.

#include <gtest/gtest.h>

#include <cmath>

#include "core/closed/cosine_roots.hpp"
#include "core/closed/joined_roots.hpp"
#include "core/closed/linear_factors.hpp"
#include "core/closed/split_roots.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/parse.hpp"
#include "core/expr/print/print.hpp"

namespace qdot {
namespace {

const std::vector<std::string> letters{"a", "b", "c", "g", "m", "q", "R"};

/// Every symbol is positive.
SignOf all_positive(Graph& graph) {
  return [&graph](const Polynomial& a) {
    std::vector<Assignment> values;
    double value = 0.7;
    for (const std::string& name : letters) values.emplace_back(graph.symbol(name), value += 0.31);
    const double x = evaluate(to_expression(graph, a), values);
    return x > 0 ? 1 : x < 0 ? -1 : 0;
  };
}

std::string joined(const std::string& text) {
  Graph graph;
  return print(with_joined_roots(parse(text, graph, letters), all_positive(graph)), Form::text);
}

std::string split(const std::string& text) {
  Graph graph;
  return print(with_split_roots(parse(text, graph, letters), all_positive(graph)), Form::text);
}

std::string factored(const std::string& text) {
  Graph graph;
  return print(with_linear_factors(parse(text, graph, letters)), Form::text);
}

TEST(ShortForms, JoinTheRootsOfAProduct) {
  EXPECT_EQ(joined("2*m*g^2*sqrt(q/(m*g))/q"), "2*g*sqrt(g*m/q)");
  EXPECT_EQ(joined("2^(1/3)*q^(1/3)/(m^(1/3)*g^(1/3))"), "(2*q/(g*m))^(1/3)");
  EXPECT_EQ(joined("q^(2/3)/(4^(1/3)*m^(2/3))"), "(q/(2*m))^(2/3)");
  EXPECT_EQ(joined("a*sqrt(b)"), "a*sqrt(b)");
}

TEST(ShortForms, SplitTheRootsOfProductsWhereThatSparesMuch) {
  EXPECT_EQ(split("(a*sqrt(b) - b*sqrt(a))/(sqrt(a*b)*(sqrt(a) - sqrt(b)))"), "1");
  EXPECT_EQ(split("sqrt(a*b)"), "sqrt(a*b)");
}

TEST(ShortForms, FindFactorsAndSquares) {
  EXPECT_EQ(factored("R^3 - 2*a*R^2 - a^2*R + 2*a^3"), "(R + a)*(a - R)*(2*a - R)");
  EXPECT_EQ(factored("sqrt(a^2 - 2*a*b + b^2 + 4*c^2)"), "sqrt(4*c^2 + (a - b)^2)");
  EXPECT_EQ(factored("a^2 + b^2 + c^2"), "a^2 + b^2 + c^2");
}

TEST(ShortForms, HaveCosinesForRootsOfChains) {
  Graph graph;
  // det of three masses at one wall: x^3 - 5 x^2 + 6 x - 1, 4 sin^2 of pi/14, 3 pi/14, 5 pi/14.
  const auto roots = cosine_roots(graph, {Number(-1), Number(6), Number(-5), Number(1)});
  ASSERT_EQ(roots.size(), 3);
  for (const Expression& root : roots) {
    const double x = evaluate(root, {});
    EXPECT_NEAR(x * x * x - 5 * x * x + 6 * x - 1, 0, 1e-12);
  }
  EXPECT_TRUE(cosine_roots(graph, {Number(-3), Number(1), Number(0), Number(2)}).empty());
}

}  // namespace
}  // namespace qdot
