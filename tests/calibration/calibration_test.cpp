// A slice of the calibration: the errors that answers state are the ones they have.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/calibration/verdict.hpp"

namespace qdot::test {
namespace {

TEST(Calibration, StatedErrorsAreTrue) {
  Tally tally;
  std::string remarks;
  for (std::uint64_t i = 0; i < 84; ++i) {
    const Asked asked = random_request(2, i);
    remarks += tally.add(asked, outcome_of(asked, 400));
  }
  EXPECT_TRUE(tally.passes()) << remarks << tally.summary();
}

// Where rounding is as large as the truncation of the check.
TEST(Calibration, ErrorsAreTrueWhereRoundingShows) {
  Tally tally;
  const Asked asked = random_request(1, 425);
  const std::string remarks = tally.add(asked, outcome_of(asked, 5000));
  EXPECT_TRUE(tally.passes()) << remarks << tally.summary();
}

// Motions that are lost while an angle winds: they had errors beyond those stated, which may be far too
// large.
TEST(Calibration, ErrorsAreNotUnderstatedWhereTheMotionIsLost) {
  Tally tally;
  std::string remarks;
  for (const auto& [seed, i] : {std::pair{1, 747}, {917, 213}}) {
    const Asked asked = random_request(static_cast<std::uint64_t>(seed), static_cast<std::uint64_t>(i));
    remarks += tally.add(asked, outcome_of(asked, 5000));
  }
  EXPECT_TRUE(tally.understates_nothing()) << remarks << tally.summary();
}

// Round-off over tens of steps of the walker: three that had errors beyond those stated.
TEST(Calibration, ErrorsAreTrueWhereImpactsPassRoundingOn) {
  Tally tally;
  std::string remarks;
  for (const std::uint64_t i : {289, 401, 1017}) {
    const Asked asked = random_request(7, i);
    remarks += tally.add(asked, outcome_of(asked, 20'000));
  }
  EXPECT_TRUE(tally.passes()) << remarks << tally.summary();
}

/// At nine of these tolerances the run was good by chance, and no farther from its check than the check from
/// the motion.
TEST(Calibration, ErrorsAreTrueWhereTheMotionAmplifiesRounding) {
  Tally tally;
  std::string remarks;
  for (const int i : {10, 32, 65, 66, 67, 149, 175, 289, 306}) {
    Asked asked = random_request(934, 145);
    asked.goal = {};
    asked.request.method = Method::taylor;
    const double rtol = std::pow(10.0, -12 + 1.5 * i / 500);
    asked.request.tolerances = {rtol, rtol * 1e-3};
    remarks += tally.add(asked, outcome_of(asked, 5000));
  }
  EXPECT_TRUE(tally.understates_nothing()) << remarks << tally.summary();
}

/// Let go within 1e-11 of the upright: what the run and its check made of their roundings, along the one
/// direction that grows, was the same by chance.
TEST(Calibration, ErrorsAreTrueBesideTheUpright) {
  Tally tally;
  std::string remarks;
  for (const std::uint64_t i : {4477, 6059, 6899}) {
    const Asked asked = random_request(2000, i);
    remarks += tally.add(asked, outcome_of(asked, 5000));
  }
  EXPECT_TRUE(tally.understates_nothing()) << remarks << tally.summary();
}

/// A walker of 2 mm that begins 100 s before t = 0: instants of impacts are rounded, and each stride makes
/// more of it.
TEST(Calibration, ErrorsAreTrueOverManyImpacts) {
  Tally tally;
  const Asked asked = random_request(3000, 3705);
  const std::string remarks = tally.add(asked, outcome_of(asked, 5000));
  EXPECT_TRUE(tally.passes()) << remarks << tally.summary();
}

TEST(Calibration, NothingSeenIsNoPass) { EXPECT_FALSE(Tally().passes()); }

}  // namespace
}  // namespace qdot::test
