// The error of rows from the differences of computations.

#include "core/motion/row_errors.hpp"

#include <gtest/gtest.h>

namespace qdot {
namespace {

using Row = std::vector<double>;

void add(RowErrors& errors, const Row& row, const std::vector<Row>& others, double t = 0) {
  std::vector<OtherRow> same_row;
  for (const Row& other : others) same_row.push_back({.row = other, .apart = {}});
  errors.add(t, row, same_row);
}

RowErrors errors_of(const std::vector<double>& scale, bool winds = false) {
  return RowErrors(scale, [winds] { return std::vector{winds}; });
}

TEST(RowErrors, AreTwiceTheLargestDifferenceMetSoFar) {
  RowErrors errors = errors_of({1, 100});
  add(errors, {0, 100}, {{1e-6, 100}, {-3e-6, 100}});
  EXPECT_NEAR(errors.so_far()[0], 6e-6, 1e-15);
  add(errors, {0, 100}, {{1e-6, 100.001}, {0, 100}});
  EXPECT_NEAR(errors.so_far()[0], 6e-6, 1e-15);
  EXPECT_NEAR(errors.so_far()[1], 2e-3, 1e-12);
}

/// A difference may be small by chance, but then the other one is off, too.
TEST(RowErrors, AreNoLessThanWhatTheOtherIsOffBy) {
  RowErrors errors = errors_of({1, 1});
  const Row row{0, 0}, other{1e-6, 1e-6}, apart{5e-6, 5e-7};
  errors.add(0, row, std::vector<OtherRow>{{.row = other, .apart = apart}});
  EXPECT_NEAR(errors.so_far()[0], 11e-6, 1e-15);
  EXPECT_NEAR(errors.so_far()[1], 2e-6, 1e-15);
}

TEST(RowErrors, AreNeverBelowTheRoundingOfANumber) {
  RowErrors errors = errors_of({1, 1e6});
  add(errors, {0, 1e6}, {{0, 1e6}});
  EXPECT_EQ(errors.so_far()[0], 0);
  EXPECT_EQ(errors.so_far()[1], 1e6 * 0x1p-52);
}

TEST(RowErrors, AreFourTimesTheRangeOfValuesOnceTheMotionIsLost) {
  RowErrors errors = errors_of({10, 10});
  add(errors, {10, 5}, {{10, 7.6}});  // 5.2 of 10 in doubt, in the second column
  add(errors, {-8, 7}, {{-8, 7}});    // agreement by chance
  EXPECT_EQ(errors.so_far()[0], 72);
  EXPECT_NEAR(errors.so_far()[1], 10.4, 1e-14);
}

/// Rows may be rare, and an angle that winds goes on between them.
TEST(RowErrors, OfALostMotionCountWhereItWasBefore) {
  RowErrors errors = errors_of({10, 10});
  add(errors, {-9, 0}, {{-9, 0}});
  add(errors, {1, 0}, {{1, 6}});
  EXPECT_EQ(errors.so_far()[0], 40);
}

/// The true angle may wind where the computed ones go to and fro, at velocities between -3 and 3.
TEST(RowErrors, OfALostAngleGrowWithTheTime) {
  RowErrors errors = errors_of({10, 3}, true);
  add(errors, {1, 3}, {{1.25, 3}}, 2);
  add(errors, {2, -3}, {{9, 3}}, 5);
  EXPECT_NEAR(errors.so_far()[0], 0.5 + 2 * 6 * 3, 1e-14);
  add(errors, {1, 0}, {{1, 0}}, 52);
  EXPECT_NEAR(errors.so_far()[0], 0.5 + 2 * 6 * 50, 1e-12);
  EXPECT_NEAR(errors.so_far()[1], 24, 1e-14);
}

}  // namespace
}  // namespace qdot
