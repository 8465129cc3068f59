// Where a run nearly meets a terminal event, or has nearly missed it: x = cos t comes to -1 at pi.

#include "core/integrate/approaches.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/core/integrate/systems.hpp"

namespace qdot {
namespace {

using namespace integrate_test;

/// x + level along the rows of a piece.
EventFunction level_of(double level) {
  return {.value = [level](double, auto y) { return y[0] + level; },
          .series =
              [level](const MotionPiece& piece, unsigned order, std::span<double> c) {
                for (unsigned k = 0; k <= order; ++k) c[k] = k <= piece.order ? piece.rows[k] : 0;
                c[0] += level;
                return 0.0;
              },
          .direction = Crossing::falling,
          .terminal = true};
}

std::vector<Approach> approaches(const EventFunction& event, Method method, double t_end = 5) {
  RunRequest request{.y_start = {1, 0}, .t_end = t_end, .events = {event}, .method = method};
  request.notes_approaches = true;
  return integrate(oscillator(), request).approaches;
}

TEST(Approaches, AreWhereItTurnsBackJustBeforeTheEvent) {
  for (const Method method : all_methods) {
    for (const double distance : {1e-3, 1e-5, 3e-7}) {
      const auto found = approaches(level_of(1 + distance), method);
      ASSERT_EQ(found.size(), 1U) << name(method) << " " << distance;
      EXPECT_FALSE(found[0].met);
      EXPECT_EQ(found[0].sign, 1);
      EXPECT_NEAR(found[0].t, std::numbers::pi, 1e-5);
      EXPECT_NEAR(found[0].state_at(0)[0], -1, 1e-7);
      EXPECT_NEAR(found[0].state_at(-0.01)[0], -std::cos(0.01), 1e-7);
    }
  }
}

TEST(Approaches, AreWhereItWouldHaveTurnedBackJustPastIt) {
  for (const Method method : all_methods) {
    for (const double distance : {1e-3, 1e-5, 3e-7}) {
      const auto found = approaches(level_of(1 - distance), method);
      ASSERT_EQ(found.size(), 1U) << name(method) << " " << distance;
      ASSERT_TRUE(found[0].met);
      EXPECT_NEAR(*found[0].met, std::acos(distance - 1), 1e-3);
      EXPECT_NEAR(found[0].t, std::numbers::pi, 1e-2);
      EXPECT_NEAR(found[0].state_at(0)[0], -1, 1e-4);
    }
  }
}

TEST(Approaches, AreNoneOfWhatIsFarAwayOrMetWithSpeed) {
  for (const Method method : all_methods) {
    EXPECT_TRUE(approaches(level_of(1.2), method).empty()) << name(method);
    EXPECT_TRUE(approaches(level_of(0.5), method).empty()) << name(method);
  }
}

TEST(Approaches, AreToEventsAfterWhichTheRunGoesOnFromBothSides) {
  for (const Method method : all_methods) {
    for (const double beyond : {1e-6, -1e-6}) {
      EventFunction that_goes_on = level_of(1 + beyond);
      that_goes_on.terminal = false;
      const auto found = approaches(that_goes_on, method);
      EXPECT_EQ(found.empty(), beyond < 0) << name(method);  // what is clearly met is not nearly met
      for (const Approach& approach : found) EXPECT_NEAR(approach.distance, 1e-6, 1e-7);
    }
  }
}

TEST(Approaches, AreWhereTheRunEndsJustBeforeAnEvent) {
  const auto found = approaches(level_of(0), Method::erk, std::numbers::pi / 2 - 1e-6);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].t, std::numbers::pi / 2 - 1e-6, 1e-12);
  EXPECT_FALSE(found[0].met);
}

TEST(Approaches, AreToWhatDecidesWhetherAnEventCounts) {
  for (const double when : {1e-9, -1e-9}) {
    EventFunction event = level_of(0.5);
    event.condition = [when](double, auto) { return when; };
    const auto found = approaches(event, Method::erk, 2.5);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_TRUE(found[0].is_condition);
    EXPECT_EQ(found[0].met.has_value(), when > 0);
    EXPECT_NEAR(found[0].t, std::acos(-0.5), 1e-6);
  }
}

TEST(Approaches, AreTakenTogetherWhereTheyAreMany) {
  // 1.02 + cos(t/4000) / 100 is nearest to 1 half-way, after 2000 periods.
  EventFunction event = level_of(1.02);
  event.value = [](double t, auto y) { return y[0] + 1.02 + 0.01 * std::cos(t / 4000); };
  event.series = [](const MotionPiece& piece, unsigned order, std::span<double> c) {
    for (unsigned k = 0; k <= order; ++k) c[k] = k <= piece.order ? piece.rows[k] : 0;
    c[0] += 1.02 + 0.01 * std::cos(piece.t / 4000);
    return 1e-5;
  };
  const double t_end = 8000 * std::numbers::pi;
  const auto found = approaches(event, Method::erk, t_end);
  ASSERT_GE(found.size(), 1000U);
  ASSERT_LT(found.size(), 2000U);
  const Approach* nearest = &found[0];
  double before = 0;
  for (const Approach& approach : found) {
    const Approach::Others all = approach.others.value_or(Approach::Others{approach.t, approach.t});
    EXPECT_LE(all.from, approach.t);
    EXPECT_GE(all.to, approach.t);
    EXPECT_NEAR(all.from, before + (before > 0 ? 2 : 1) * std::numbers::pi, 1e-2);  // none is left out
    before = all.to;
    if (approach.distance < nearest->distance) nearest = &approach;
  }
  EXPECT_GT(before, t_end - 2 * std::numbers::pi);
  EXPECT_NEAR(nearest->t, t_end / 2, 20);
}

TEST(Approaches, ThatAreTakenTogetherHaveTheErrorsOfAll) {
  std::vector<Approach> all;
  for (const double distance : {3.0, 1.0, 4.0, 1.5})
    all.push_back({.t = 10 - distance, .distance = distance, .apart = {distance}, .unseen = {1 / distance}});
  all.push_back({.event = 1, .t = 20, .distance = 2});
  all.push_back({.t = 21, .met = 20});
  take_together(all);
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0].t, 9);
  EXPECT_EQ(all[0].apart, std::vector{3.0});
  EXPECT_EQ(all[0].unseen, std::vector{1.0});
  EXPECT_EQ(all[0].others->from, 7);
  EXPECT_EQ(all[0].others->to, 9);
  EXPECT_EQ(all[1].distance, 1.5);
  EXPECT_EQ(all[1].apart, std::vector{4.0});
  EXPECT_FALSE(all[2].others);
  EXPECT_FALSE(all[3].others);
}

}  // namespace
}  // namespace qdot
