// Fractions over powers of one bracket become one fraction where that is shorter.

#include "core/expr/common_denominator.hpp"

#include <gtest/gtest.h>

#include "core/expr/parse.hpp"
#include "core/expr/print/print.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

std::string simplified(const std::string& text) {
  Graph graph;
  const std::vector<std::string> names{"r", "v", "w", "z", "k"};
  return print(simplify(parse(text, graph, names)), Form::text, {names, {}, {}});
}

TEST(CommonDenominators, AreTakenWhereTheSumIsShorter) {
  EXPECT_EQ(simplified("v^2/(1 - v^2) + 1"), "1/(1 - v^2)");
  EXPECT_EQ(simplified("v^2/(1 - v^2)^(3/2) + 1/sqrt(1 - v^2)"), "1/(1 - v^2)^(3/2)");
  EXPECT_EQ(simplified("v^2/sqrt(1 - v^2) + sqrt(1 - v^2)"), "1/sqrt(1 - v^2)");
  EXPECT_EQ(simplified("2/(r^2 + z^2)^(3/2) - 3*r^2/(r^2 + z^2)^(5/2)"), "(2*z^2 - r^2)/(r^2 + z^2)^(5/2)");
  EXPECT_EQ(simplified("r*v*(v + 2/(r^2 + z^2)^(3/2) - 3*r^2/(r^2 + z^2)^(5/2))"),
            "r*v*(v + (2*z^2 - r^2)/(r^2 + z^2)^(5/2))");
}

TEST(CommonDenominators, MayCancel) {
  EXPECT_EQ(simplified("k/(1 - v^2 - w^2) - k*v^2/(1 - v^2 - w^2) - k*w^2/(1 - v^2 - w^2)"), "k");
}

TEST(CommonDenominators, AreNotTakenWhereTheSumIsLonger) {
  EXPECT_EQ(simplified("k/(1 + v) + w"), "w + k/(1 + v)");
  EXPECT_EQ(simplified("k/(1 + v) + w/(1 + v)^2"), "(k + w/(1 + v))/(1 + v)");
}

}  // namespace
}  // namespace qdot
