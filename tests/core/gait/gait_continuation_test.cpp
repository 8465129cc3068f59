// Critical values of the walker's parameters against reference values, and the branches between them.

#include <gtest/gtest.h>

#include <cmath>

#include "core/gait/gait_continuation.hpp"
#include "tests/support/scenes.hpp"

namespace qdot {
namespace {

constexpr std::size_t l = 2, gamma = 3;

GaitBifurcations critical_with(const Values& given, std::size_t index, double from, double to) {
  static const Dynamics walker(test::model_of("compass_walker"));
  return critical_gaits(walker, parameter_values(walker.model(), given), index, from, to);
}

TEST(GaitContinuation, FindsThePeriodDoublingOfTheLongGait) {
  const GaitBifurcations found = critical_with({{"g", 1}}, gamma, 0.002, 0.05);
  ASSERT_EQ(found.critical.size(), 1u);
  const CriticalGait& doubling = found.critical[0];
  EXPECT_EQ(doubling.kind, CriticalGait::Kind::period_doubling);
  EXPECT_NEAR(doubling.value, 0.0150884379411194636, doubling.error + 1e-17);
  EXPECT_LT(doubling.error, 1e-12);
  EXPECT_NEAR(doubling.state[0], 0.237165863591579096, 1e-11);
  ASSERT_EQ(doubling.multipliers.size(), 2u);
  EXPECT_NEAR(doubling.multipliers[0].real(), -1, 1e-9);
  EXPECT_NEAR(doubling.multipliers[1].real(), -0.2976, 1e-4);
}

TEST(GaitContinuation, FollowsBothGaitsOverTheWholeRange) {
  const GaitBifurcations found = critical_with({{"g", 1}}, gamma, 0.002, 0.05);
  ASSERT_EQ(found.branches.size(), 2u);
  for (const GaitBranch& branch : found.branches) {
    EXPECT_EQ(branch.points.front().parameter, 0.002);
    EXPECT_EQ(branch.points.back().parameter, 0.05);
    for (const GaitPoint& point : branch.points) {
      EXPECT_EQ(point.stable, branch.kind == Gait::Kind::long_step && point.parameter < 0.01508843794112);
    }
  }
}

TEST(GaitContinuation, FindsNothingWhereOnlyTheUnitsChange) {
  const GaitBifurcations found = critical_with({{"gamma", 0.01}}, l, 0.1, 2);
  EXPECT_TRUE(found.critical.empty());
  ASSERT_EQ(found.branches.size(), 2u);
  for (const GaitBranch& branch : found.branches) {
    for (const GaitPoint& point : branch.points) EXPECT_NEAR(point.state[0], branch.points[0].state[0], 1e-8);
  }
}

TEST(GaitContinuation, SaysWhyThereIsNoBranch) {
  const GaitBifurcations found = critical_with({}, gamma, -0.1, -0.01);
  EXPECT_TRUE(found.critical.empty());
  EXPECT_TRUE(found.branches.empty());
  EXPECT_FALSE(found.reason.empty());
}

}  // namespace
}  // namespace qdot
