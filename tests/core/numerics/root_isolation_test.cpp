// All zeros are found, each once and enclosed, of systems whose zeros are known.

#include "core/numerics/root_isolation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/random.hpp"

namespace qdot {
namespace {

using Span = std::span<const Interval>;

/// product of (x - r) and its derivative.
SquareSystem polynomial(const std::vector<double>& roots) {
  const auto without = [roots](Span x, std::size_t skipped) {
    Interval product(1);
    for (std::size_t i = 0; i < roots.size(); ++i) {
      if (i != skipped) product = product * (x[0] - Interval(roots[i]));
    }
    return product;
  };
  return {1, [=](Span x, std::span<Interval> out) { out[0] = without(x, roots.size()); },
          [=](Span x, std::span<Interval> out) {
            out[0] = without(x, 0);
            for (std::size_t i = 1; i < roots.size(); ++i) out[0] = out[0] + without(x, i);
          }};
}

TEST(ZerosInABox, AllOfAPolynomialAreFoundOnce) {
  test::Random random(1);
  for (int k = 0; k < 200; ++k) {
    std::vector<double> roots;
    for (int i = 0; i < 5; ++i) roots.push_back(random.real(-5, 5));
    std::sort(roots.begin(), roots.end());
    const Isolation found = isolate_zeros(polynomial(roots), {Interval(-6, 6)});
    ASSERT_TRUE(found.complete);
    ASSERT_EQ(found.zeros.size(), roots.size());
    for (std::size_t i = 0; i < roots.size(); ++i) {
      EXPECT_TRUE(found.zeros[i].simple);
      EXPECT_TRUE(found.zeros[i].enclosure[0].contains(roots[i])) << roots[i];
      EXPECT_LT(found.zeros[i].enclosure[0].radius(), 1e-8);
    }
  }
}

TEST(ZerosInABox, OnItsEdgesAndAtItsMiddleCount) {
  const Isolation found = isolate_zeros(polynomial({-2, 0, 2}), {Interval(-2, 2)});
  ASSERT_EQ(found.zeros.size(), 3U);
  EXPECT_TRUE(found.zeros[0].enclosure[0].contains(-2));
  EXPECT_TRUE(found.zeros[1].enclosure[0].contains(0));
  EXPECT_TRUE(found.zeros[2].enclosure[0].contains(2));
}

TEST(ZerosInABox, OfAnySizeAreFoundInAHugeOne) {
  const Isolation found = isolate_zeros(polynomial({-1e9, 1e-7, 3.0, 2e12}), {Interval(-1e15, 1e15)});
  ASSERT_TRUE(found.complete);
  ASSERT_EQ(found.zeros.size(), 4U);
  EXPECT_TRUE(found.zeros[3].enclosure[0].contains(2e12));
}

TEST(ZerosInABox, MultipleOnesAreOneClusterThatIsNotCalledSimple) {
  for (const auto& roots : {std::vector{1.0, 1.0}, std::vector{1.0, 1.0, 1.0}}) {
    const Isolation found = isolate_zeros(polynomial(roots), {Interval(-3, 4)});
    ASSERT_EQ(found.zeros.size(), 1U);
    EXPECT_FALSE(found.zeros[0].simple);
    EXPECT_TRUE(found.zeros[0].enclosure[0].contains(1));
    EXPECT_LT(found.zeros[0].enclosure[0].width(), 1e-3);
  }
}

TEST(ZerosInABox, NearlyMultipleOnesAreToldApartWhileRoundingAllowsIt) {
  const Isolation apart = isolate_zeros(polynomial({1, 1 + 1e-6}), {Interval(-3, 4)});
  EXPECT_EQ(apart.zeros.size(), 2U);
  const Isolation missed = isolate_zeros({1, [](Span x, auto out) { out[0] = square(x[0]) + Interval(1e-9); },
                                          [](Span x, auto out) { out[0] = Interval(2) * x[0]; }},
                                         {Interval(-3, 4)});
  EXPECT_TRUE(missed.zeros.empty());
}

TEST(ZerosInABox, PolesAreNone) {
  const Isolation found =
      isolate_zeros({1, [](Span x, auto out) { out[0] = Interval(1) / (x[0] - Interval(0.3)); },
                     [](Span x, auto out) { out[0] = Interval(-1) / square(x[0] - Interval(0.3)); }},
                    {Interval(-1, 1)});
  EXPECT_TRUE(found.complete);
  EXPECT_TRUE(found.zeros.empty());
}

TEST(ZerosInABox, CirclesAndLinesMeetInThePlane) {
  test::Random random(2);
  for (int k = 0; k < 50; ++k) {
    const double angle = random.real(-3, 3);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double d = random.real(-1.5, 1.5);
    const SquareSystem system{2,
                              [=](Span x, auto out) {
                                out[0] = square(x[0]) + square(x[1]) - Interval(1);
                                out[1] = Interval(c) * x[0] + Interval(s) * x[1] - Interval(d);
                              },
                              [=](Span x, auto out) {
                                out[0] = Interval(2) * x[0];
                                out[1] = Interval(2) * x[1];
                                out[2] = c;
                                out[3] = s;
                              }};
    const Isolation found = isolate_zeros(system, {Interval(-3, 3), Interval(-3, 3)});
    ASSERT_EQ(found.zeros.size(), std::abs(d) < 1 ? 2U : 0U) << d;
    for (const IsolatedZero& zero : found.zeros) {
      const double x = zero.enclosure[0].middle();
      const double y = zero.enclosure[1].middle();
      EXPECT_NEAR(x * x + y * y, 1, 1e-13);
      EXPECT_NEAR(c * x + s * y, d, 1e-13);
    }
  }
}

TEST(ZerosInABox, EquationsMayBeOfVeryDifferentSizes) {
  for (const double size : {1.0, 1e12, 1e25, 1e60}) {
    const Interval large(size);
    const SquareSystem fold{2,
                            [&](Span x, std::span<Interval> out) {
                              out[0] = square(x[0]) - x[1];
                              out[1] = large * x[0];
                            },
                            [&](Span x, std::span<Interval> out) {
                              out[0] = Interval(2) * x[0];
                              out[1] = -1;
                              out[2] = large;
                              out[3] = 0;
                            }};
    const Isolation found = isolate_zeros(fold, {Interval(-1, 1.3), Interval(-2, 3.1)});
    ASSERT_TRUE(found.complete);
    ASSERT_EQ(found.zeros.size(), 1U) << size;
    EXPECT_TRUE(found.zeros[0].simple) << size;
  }
}

TEST(ZerosInABox, SinesInSpaceHaveAsManyAsTheyShould) {
  const SquareSystem system{3,
                            [](Span x, auto out) {
                              for (std::size_t i = 0; i < 3; ++i)
                                out[i] = sin(x[i]) + Interval(0.1) * x[(i + 1) % 3];
                            },
                            [](Span x, auto out) {
                              for (std::size_t i = 0; i < 9; ++i) out[i] = 0.0;
                              for (std::size_t i = 0; i < 3; ++i) {
                                out[3 * i + i] = cos(x[i]);
                                out[3 * i + (i + 1) % 3] = Interval(0.1);
                              }
                            }};
  const Isolation found = isolate_zeros(system, {Interval(-2, 2), Interval(-2, 2), Interval(-2, 2)});
  EXPECT_TRUE(found.complete);
  EXPECT_EQ(found.zeros.size(), 1U);  // |sin x| > 0.2 away from 0 there
  EXPECT_TRUE(found.zeros[0].enclosure[0].contains(0.0));
}

TEST(ZerosInABox, ACubicThreeUnitsPastItsPitchforkHasAllItsZerosInWhatIsFound) {
  const double excess = 3 * 0x1p-52;  // x^3 - (b - c) x with b = 1 + excess, c = 1
  const Interval b(1 + excess), c(1);
  const SquareSystem cubic{1, [=](Span x, auto out) { out[0] = power(x[0], 3) + c * x[0] - b * x[0]; },
                           [=](Span x, auto out) { out[0] = Interval(3) * square(x[0]) + c - b; }};
  const Isolation found = isolate_zeros(cubic, {Interval(-2, 3)});
  ASSERT_TRUE(found.complete && found.undecided.empty() && found.poles.empty());
  for (const double zero : {-std::sqrt(excess), 0.0, std::sqrt(excess)}) {
    EXPECT_TRUE(std::ranges::any_of(found.zeros, [&](const IsolatedZero& place) {
      return place.enclosure[0].contains(zero);
    })) << zero;
  }
}

TEST(ZerosInABox, WhereAFunctionIsTooSmallToTellTheRegionIsUndecidedAndNoZeroIsClaimed) {
  const SquareSystem falling{
      1,
      [](Span x, auto out) { out[0] = evaluate(Function::exp, Interval(0) - x[0]) * Interval(-1e-300, 1); },
      [](Span x, auto out) { out[0] = -evaluate(Function::exp, Interval(0) - x[0]); }};
  const Isolation found = isolate_zeros(falling, {Interval(1, 1e6)});
  EXPECT_TRUE(found.zeros.empty());
  EXPECT_FALSE(found.complete && found.undecided.empty());
}

TEST(ZerosInABox, WhatElseIsKnownLeavesBoxesOut) {
  SquareSystem two = polynomial({-1, 1});
  two.excluded = [](Span x, Span) { return x[0].upper < 0; };
  const Isolation found = isolate_zeros(two, {Interval(-3, 4)});
  ASSERT_EQ(found.zeros.size(), 1U);
  EXPECT_TRUE(found.zeros[0].enclosure[0].contains(1));
  EXPECT_TRUE(found.zeros[0].alone[0].contains(found.zeros[0].enclosure[0]));
}

TEST(ZerosInABox, GivingUpIsSaid) {
  const SquareSystem flat{1, [](Span, auto out) { out[0] = Interval(-1, 1); },
                          [](Span, auto out) { out[0] = Interval(-1, 1); }};
  EXPECT_FALSE(isolate_zeros(flat, {Interval(-1, 1)}, {}, 3).complete);
}

TEST(ZerosInABox, OfASearchGivenUpNoneLieOutsideTheBox) {
  const auto unless_wide = [](const Interval& x, const Interval& value) {
    return x.width() < 1e-4 ? value : Interval(-100, 100);
  };
  const SquareSystem cosine{
      1, [&](Span x, auto out) { out[0] = unless_wide(x[0], evaluate(Function::cos, x[0])); },
      [&](Span x, auto out) { out[0] = unless_wide(x[0], -evaluate(Function::sin, x[0])); }};
  const Isolation none = isolate_zeros(cosine, {Interval(-1.5, 1.2)}, {}, 120);
  EXPECT_FALSE(none.complete);
  EXPECT_TRUE(none.zeros.empty());
}

}  // namespace
}  // namespace qdot
