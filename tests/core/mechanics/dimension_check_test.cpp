// Dimensions of expressions: what they come to, and the first mistake in words.

#include "core/mechanics/dimension_check.hpp"

#include <gtest/gtest.h>

#include "core/expr/parse.hpp"

namespace qdot {
namespace {

const std::vector<std::string> names{"m", "l", "g", "k", "theta", "t"};

DimensionResult check(const std::string& text) {
  Graph graph;
  SymbolDimensions dimensions;
  const auto declare = [&](const char* name, const char* unit) {
    dimensions[graph.symbol(name).id()] = parse_unit(unit)->dimension;
  };
  declare("m", "kg");
  declare("l", "m");
  declare("g", "m/s^2");
  declare("k", "N/m");
  declare("theta", "rad");
  declare("t", "s");
  return dimension_of(parse(text, graph, names), dimensions);
}

TEST(DimensionOf, AnExpressionFollowsFromItsSymbols) {
  for (const auto& [text, unit] :
       std::vector<std::pair<std::string, std::string>>{{"m*g*l*cos(theta)", "J"},
                                                        {"k*l^2/2 + m*g*l", "J"},
                                                        {"sqrt(l/g)", "s"},
                                                        {"(m/k)^(1/2)", "s"},
                                                        {"theta + sin(t*sqrt(g/l))", "1"},
                                                        {"exp(-t*sqrt(k/m))*l", "m"},
                                                        {"abs(-l)", "m"},
                                                        {"sign(l)", "1"},
                                                        {"3", "1"},
                                                        {"pi*l", "m"}}) {
    const DimensionResult found = check(text);
    EXPECT_EQ(found.mistake, "") << text;
    ASSERT_TRUE(found.dimension.has_value()) << text;
    EXPECT_EQ(to_text(*found.dimension), to_text(parse_unit(unit)->dimension)) << text;
  }
}

TEST(DimensionOf, ZeroFitsAny) {
  EXPECT_FALSE(check("0").dimension.has_value());
  EXPECT_EQ(check("0").mistake, "");
  EXPECT_EQ(check("l - l").mistake, "");
}

TEST(DimensionOf, AMistakeNamesItsPlace) {
  EXPECT_EQ(check("l + theta").mistake, "it adds 'l' in m to 'theta' in 1");
  EXPECT_EQ(check("m*(g + l/t^3)").mistake, "it adds 'g' in m/s^2 to 'l/t^3' in m/s^3");
  EXPECT_EQ(check("sin(t)").mistake, "it takes sin of 't', which is in s and not a pure number");
  EXPECT_EQ(check("exp(l/g)").mistake, "it takes exp of 'l/g', which is in s^2 and not a pure number");
  EXPECT_EQ(check("1 + l").mistake, "it adds '1' in 1 to 'l' in m");
}

}  // namespace
}  // namespace qdot
