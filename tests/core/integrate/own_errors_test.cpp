// What two samples show of errors that cancel in one: motions of x'' = x that come to rest at its saddle.

#include "core/integrate/own_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/integrate/pulled.hpp"

namespace qdot {
namespace {

using namespace integrate_test;

constexpr double length = 0.5;
constexpr int steps = 40;

/// e of x and x' after motions from (1, -1).
std::vector<double> off_by(const Apart& start, std::span<const double> defect) {
  const Originals originals{pulled_by(1), pulled_by(1), {}};
  OwnErrors errors(originals, start, 0);
  take_steps(pulled_by(1), {1, -1}, length, steps, defect,
             [&](const MotionPiece& step) { errors.follow(step); });
  return {errors.in_last_step(0), errors.in_last_step(1)};
}

TEST(OwnErrors, CountTheRoundingOfStepsThatTheStartDoesNotShow) {
  constexpr double e = 1e-15;  // along v = -x, which decays
  const std::vector<double> off = off_by({{e, -e}, {0, 0}}, {});
  const double grown = std::exp(length * (steps - 1)) / 2;
  EXPECT_GT(off[0], 0x1p-53 * grown / 10);
  EXPECT_LT(off[0], 0x1p-53 * grown * 10);
}

TEST(OwnErrors, OfHiddenDefectsAddUpAlongWhatGrows) {
  constexpr double e = 1e-6, defect = 1e-9;
  const std::vector<double> off = off_by({{e, -e}, {0, 0}}, std::vector{0.0, defect});
  double sum = 0;  // its terms do not show the defect, which so may have acted from each step's beginning on
  for (int i = 1; i <= steps; ++i) sum += defect * length * std::exp(length * i) / 2;
  EXPECT_GT(off[0], 0.5 * sum);
  EXPECT_LT(off[0], 2 * sum);
}

TEST(OwnErrors, SayWhatTheSecondSampleShowsWithoutItsEnlargement) {
  constexpr double e = 1e-12;
  const std::vector<double> off = off_by({{0, 0}, {e * OwnErrors::enlarged, 0}}, {});
  EXPECT_NEAR(off[0], e * std::cosh(length * steps), 1e-3 * off[0]);
}

/// Beside a motion that decays, and comes back by its own rounding, what is apart becomes as large as it is.
TEST(OwnErrors, OfRoundingAreAsLargeAsALostMotion) {
  const Originals originals{pulled_by(1), pulled_by(1), {}};
  OwnErrors errors(originals, {{0, 0}, {0x1p-53 * OwnErrors::enlarged, 0}}, 0);
  double largest = 0;
  take_steps(pulled_by(1), {1, -1 + 0x1p-50}, length, 2 * steps + 20, std::vector<double>{},
             [&](const MotionPiece& step) {
               errors.follow(step);
               largest = std::max(largest, std::abs(step.rows[0]));
             });
  EXPECT_GT(largest, 1e3);
  EXPECT_GT(errors.in_last_step(0), 0x1p-4 * largest);
  EXPECT_LT(errors.in_last_step(0), 4 * largest);
  EXPECT_NEAR(errors.rounding_in_last_step(0), errors.in_last_step(0), 1e-2 * largest);
}

/// As motions of one tape are, and how often that is asked.
Originals side_by_side(Originals originals, int& asked) {
  originals.both = [first = originals.asked.expansion, second = originals.rounded.expansion, &asked](
                       double t, std::span<const PairOfDoubles> y, unsigned highest,
                       std::span<PairOfDoubles> c) {
    std::vector<double> one(y.size()), other(y.size()), c_of_one(c.size()), c_of_other(c.size());
    for (std::size_t i = 0; i < y.size(); ++i) {
      one[i] = y[i][0];
      other[i] = y[i][1];
    }
    (void)first(t, one, highest, c_of_one);
    (void)second(t, other, highest, c_of_other);
    for (std::size_t i = 0; i < c.size(); ++i) c[i] = PairOfDoubles{c_of_one[i], c_of_other[i]};
    ++asked;
    return true;
  };
  return originals;
}

TEST(OwnErrors, AreTheSameWhereBothMotionsAreExpandedSideBySide) {
  const Originals apart{pulled_by(1.001), pulled_by(1.002), {}};
  int asked = 0;
  const Originals together = side_by_side(apart, asked);
  Originals refused = apart;
  refused.both = [](double, std::span<const PairOfDoubles>, unsigned, std::span<PairOfDoubles>) {
    return false;
  };
  const Apart start{{1e-9, 2e-9}, {-3e-6, 4e-6}};
  OwnErrors one_by_one(apart, start, 0), at_once(together, start, 0), one_by_one_after_all(refused, start, 0);
  const std::vector defect{0.0, 1e-12};
  take_steps(pulled_by(1), {1, -1}, length, steps, defect, [&](const MotionPiece& step) {
    one_by_one.follow(step);
    at_once.follow(step);
    one_by_one_after_all.follow(step);
    for (const OwnErrors* other : {&at_once, &one_by_one_after_all}) {
      EXPECT_EQ(one_by_one.now().by_truncation, other->now().by_truncation) << step.t;
      EXPECT_EQ(one_by_one.now().by_rounding, other->now().by_rounding) << step.t;
    }
  });
  EXPECT_EQ(asked, steps);
}

/// x'' = -x for a quarter of a period: a force that is off by e all along moves x by e.
TEST(OwnErrors, CountARoundingOfForcesThatIsTheSameAllAlong) {
  constexpr double e = 1e-10, start = 1e-16, short_h = 0.4;
  const std::vector rounding{e};
  for (const double x : {start, -start}) {
    for (const double v : {start, -start}) {
      const Originals originals{pulled_by(-1), pulled_by(-1), {}};
      OwnErrors errors(originals, {{0, 0}, {x, v}}, 0);
      take_steps(pulled_by(-1), {2, 0}, short_h, 4, std::vector{0.0, 0.0}, [&](MotionPiece step) {
        step.rounding = rounding;
        errors.follow(step);
      });
      EXPECT_GT(errors.in_last_step(0), 0.8 * e) << x << " " << v;
      EXPECT_LT(errors.in_last_step(0), 4 * e) << x << " " << v;
      EXPECT_GT(errors.in_last_step(1), 0.8 * e) << x << " " << v;
    }
  }
}

/// A motion at rest whose force is rounded by e: its speed may be e t, whatever the samples have reached.
TEST(OwnErrors, CountWhatRoundingDoesToAForceThatIsZero) {
  constexpr double e = 1e3, rest = 0;
  const Originals originals{pulled_by(0), pulled_by(0), {}};
  OwnErrors errors(originals, {{0, 0}, {0, 0}}, 0);
  const std::vector<double> rows(2 * (order + 1), rest), defect(2), rounding{e};
  for (int i = 0; i < 3; ++i)
    errors.follow(
        {.t = i * length, .h = length, .rows = rows, .order = order, .defect = defect, .rounding = rounding});
  const double some = std::ldexp(e, 1 - static_cast<int>(order));  // counts twice
  EXPECT_NEAR(errors.in_last_step(1), e * 3 * length, some);
  EXPECT_NEAR(errors.in_last_step(0), e * 9 * length * length / 2, some);
}

}  // namespace
}  // namespace qdot
