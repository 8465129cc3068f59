// Rows at the instants of events beside those of the grid.

#include "core/motion/event_rows.hpp"

#include <gtest/gtest.h>

namespace qdot {
namespace {

Simulation motion_with(const std::vector<double>& events) {
  Simulation motion;
  motion.rows = 3;
  for (const double t : events) motion.events.push_back({"event", t, {}});
  return motion;
}

const std::vector<double> grid{0, 1, 2};

TEST(EventRows, StandInOrderWithThoseOfTheGridAndOnceAnInstant) {
  const EventRows rows(grid, motion_with({0.5, 1, 1.5, 1.5}));
  EXPECT_EQ(rows.instants(), (std::vector<double>{0, 0.5, 1, 1.5, 2}));
  EXPECT_EQ(rows.events(), (std::vector<double>{0.5, 1, 1.5}));
  EXPECT_EQ(rows.place(1), 1U);
  EXPECT_FALSE(rows.place(0.7));
}

TEST(EventRows, EndWithTheLastRowOfTheMotion) {
  EXPECT_EQ(EventRows(grid, motion_with({0.5, 2.5})).events(), std::vector<double>{0.5});
}

TEST(EventRows, AreAtAnImpactButNotBesideOne) {
  Simulation motion = motion_with({0.5, 1.2, 1.2 + 1e-14});
  motion.sections.push_back({1.2, 1.2, {}, {}, {}});
  EXPECT_EQ(EventRows(grid, motion).events(), (std::vector<double>{0.5, 1.2}));
}

TEST(EventRows, AreSetApartFromTheTables) {
  const EventRows rows(grid, motion_with({0.5, 1}));
  Simulation other;
  other.rows = 3;  // of four: it ended before the last one
  other.states = {0, 10, 0.5, 10.5, 1, 11};
  other.apart = {1, 2, 3, 4, 5, 6};
  rows.set_apart(other, 2);
  EXPECT_EQ(other.rows, 2U);
  EXPECT_EQ(other.states, (std::vector<double>{0, 10, 1, 11}));
  EXPECT_EQ(other.at_events.states, (std::vector<double>{0.5, 10.5, 1, 11}));
  EXPECT_EQ(other.at_events.apart, (std::vector<double>{3, 4, 5, 6}));
}

}  // namespace
}  // namespace qdot
