#include "core/grading/number_rule.hpp"

#include <gtest/gtest.h>

namespace qdot {
namespace {

using enum Comparison;

/// At the exact boundaries that the systems' own documents give.
TEST(NumberRule, RelabsIsNumpysAllclose) {
  const NumberRule rule{.comparison = relabs, .rtol = 0.25, .atol = 0.5};
  EXPECT_TRUE(accepts(rule, 9.5, 8));  // 0.5 + 0.25 * 8 = 2.5 is allowed
  EXPECT_TRUE(accepts(rule, 10.5, 8));
  EXPECT_FALSE(accepts(rule, 10.501, 8));
  EXPECT_TRUE(accepts({.comparison = relabs}, 1e-8, 0));
  EXPECT_FALSE(accepts({.comparison = relabs}, 1.01e-8, 0));
}

TEST(NumberRule, SigfigIsStrictlyInside) {
  const NumberRule rule{.comparison = sigfig, .digits = 3};
  EXPECT_TRUE(accepts(rule, 123.5, 123));
  EXPECT_FALSE(accepts(rule, 123.51, 123));
  EXPECT_TRUE(accepts(rule, 0.0050, 0));  // digits - 1 places for zero
  EXPECT_FALSE(accepts(rule, 0.0051, 0));
  EXPECT_TRUE(accepts(rule, 1.005, 1));  // a power of ten has one digit before the point
  EXPECT_FALSE(accepts(rule, 1.0052, 1));
  EXPECT_FALSE(accepts(rule, 0.0999, 0.1006));
}

TEST(NumberRule, DecdigCountsPlaces) {
  const NumberRule rule{.comparison = decdig, .digits = 2};
  EXPECT_TRUE(accepts(rule, 1234.005, 1234));
  EXPECT_FALSE(accepts(rule, 1234.0052, 1234));
}

TEST(NumberRule, StacksRelativeTakesTheBoundaryAndItsAbsoluteDoesNot) {
  EXPECT_TRUE(accepts({.comparison = stack_relative, .tolerance = 0.25}, 5, 4));
  EXPECT_FALSE(accepts({.comparison = stack_relative}, 1e-300, 0));
  EXPECT_FALSE(accepts({.comparison = stack_absolute, .tolerance = 1}, 5, 4));
  EXPECT_TRUE(accepts({.comparison = stack_absolute, .tolerance = 1}, 4.9, 4));
}

TEST(NumberRule, WebworkIsAbsoluteNearZero) {
  const NumberRule rule{.comparison = webwork, .tolerance = 0.001};
  EXPECT_FALSE(accepts({.comparison = webwork, .tolerance = 0.25}, 5, 4));
  EXPECT_TRUE(accepts(rule, 1.0009, 1));
  EXPECT_TRUE(accepts(rule, 9e-13, 0));
  EXPECT_FALSE(accepts(rule, 1.1e-12, 0));
  EXPECT_TRUE(accepts({.comparison = webwork, .tolerance = 0.1, .is_relative = false}, 100.09, 100));
}

TEST(NumberRule, GivesNoVerdictThatTheErrorOfTheExpectedNumberCouldTurn) {
  const NumberRule rule{.comparison = stack_absolute, .tolerance = 0.1};
  const auto with = [&](double submitted, KnownNumber expected) {
    return compare(rule, {}, std::array{submitted}, std::array{expected});
  };
  EXPECT_EQ(with(1.05, {1, 0.01}), Agreement::yes);
  EXPECT_EQ(with(1.05, {1, 0.06}), Agreement::unknown);
  EXPECT_EQ(with(1.2, {1, 0.01}), Agreement::no);
  EXPECT_EQ(with(1.5, {1, 0.9}), Agreement::unknown);
}

const std::vector<KnownNumber> expected{{0, 0}, {3.14159265, 0}, {0.5, 0}};

TEST(Grouping, OrderMattersUnlessItIsASet) {
  const std::vector<double> submitted{0.5, 0, 3.14159265};
  EXPECT_EQ(compare({}, {}, submitted, expected), Agreement::no);
  EXPECT_EQ(compare({}, {.any_order = true}, submitted, expected), Agreement::yes);
  const std::vector<double> twice{0, 0, 3.14159265};
  EXPECT_EQ(compare({}, {.any_order = true}, twice, expected), Agreement::no);
}

/// 1.02 is near both, 0.99 only near 1: the first that fits must not be taken for good.
TEST(Grouping, ASetIsMatchedAsAWhole) {
  const NumberRule rule{.comparison = stack_absolute, .tolerance = 0.035};
  const std::vector<KnownNumber> close{{1, 0}, {1.05, 0}};
  EXPECT_EQ(compare(rule, {.any_order = true}, std::array{1.02, 0.99}, close), Agreement::yes);
  EXPECT_EQ(compare(rule, {.any_order = true}, std::array{0.98, 0.99}, close), Agreement::no);
}

TEST(Grouping, AnglesAgreeModuloATurn) {
  const double turn = 6.283185307179586;
  const Grouping angles{.any_order = true, .any_scale = false, .period = turn};
  const std::vector<double> submitted{-3.14159265, 0.5 - 3 * turn, turn};
  EXPECT_EQ(compare({}, angles, submitted, expected), Agreement::yes);
  EXPECT_EQ(compare({}, {.any_order = true}, submitted, expected), Agreement::no);
}

TEST(Grouping, ADirectionHasAnyScaleButZero) {
  const std::vector<KnownNumber> shape{{1, 0}, {-2, 0}};
  const Grouping direction{.any_scale = true};
  EXPECT_EQ(compare({}, direction, std::array{-0.5, 1.0}, shape), Agreement::yes);
  EXPECT_EQ(compare({}, direction, std::array{1.0, 2.0}, shape), Agreement::no);
  EXPECT_EQ(compare({}, direction, std::array{0.0, 0.0}, shape), Agreement::no);
  EXPECT_EQ(compare({}, direction, std::array{1.0}, shape), Agreement::no);
}

}  // namespace
}  // namespace qdot
