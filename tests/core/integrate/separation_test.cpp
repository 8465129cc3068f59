// Two motions of x'' = k x that begin apart.

#include "core/integrate/separation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/integrate/pulled.hpp"

namespace qdot {
namespace {

using namespace integrate_test;

void follow(Separation& separation, const MotionPiece& step) {
  StepTerms terms(2);
  terms.take(step);
  separation.follow(step, terms);
}

struct Steps {
  double k{}, k_of_reference{};
  std::vector<double> own{};  ///< error of each step
  double h{0.5};
  std::vector<double> start{1, 0};
  Separation::Scale scale{Separation::Scale::as_it_is};

  [[nodiscard]] std::vector<double> apart(std::vector<double> moved_by, int count) const {
    const RightHandSide original = pulled_by(k), reference = pulled_by(k_of_reference);
    Separation separation(original, std::move(moved_by), scale);
    take_steps(reference, start, h, count, {}, [&](const MotionPiece& step) {
      follow(separation, step);
      separation.add(own, separation.now());
    });
    return separation.in_last_step();
  }
};

TEST(Separation, GrowsAsTheMotionDoes) {
  const auto apart = Steps{.k = 1, .k_of_reference = 1}.apart({1e-9, 0}, 24);
  EXPECT_NEAR(apart[0], 1e-9 * std::cosh(12), 1e-4 * apart[0]);
  EXPECT_NEAR(apart[1], 1e-9 * std::sinh(12), 1e-4 * apart[1]);
}

TEST(Separation, OfAnOscillationDoesNotGrow) {
  const auto apart = Steps{.k = -1, .k_of_reference = -1}.apart({1e-9, 0}, 400);
  EXPECT_NEAR(std::hypot(apart[0], apart[1]), 1e-9, 5e-10);  // the larger of both ends
}

/// More terms than the first try has.
TEST(Separation, IsThatOfLongSteps) {
  const auto apart = Steps{.k = 1, .k_of_reference = 1, .h = 6}.apart({1e-12, 0}, 2);
  EXPECT_NEAR(apart[0], 1e-12 * std::cosh(12), 1e-3 * apart[0]);
}

TEST(Separation, OfLongStepsIsFoundByTheOrderThatDidBefore) {
  RightHandSide original = pulled_by(-1);
  std::vector<unsigned> orders;
  original.expansion = [&orders, expansion = original.expansion](double t, std::span<const double> y,
                                                                 unsigned order, std::span<double> c) {
    orders.push_back(order);
    return expansion(t, y, order, c);
  };
  Separation separation(original, {1e-9, 0});
  take_steps(pulled_by(-1), {1, 0}, 3, 4, {}, [&](const MotionPiece& step) { follow(separation, step); });
  ASSERT_EQ(orders.size(), 5U);  // more than the first was needed once
  EXPECT_EQ(orders[1], order);
  for (const unsigned later : std::span(orders).subspan(2)) EXPECT_LT(later, 14U);
}

TEST(Separation, ErrorsOfStepsAddUpAlongWhatGrows) {
  const auto apart = Steps{.k = 1, .k_of_reference = 1, .own = {1e-9, 0}}.apart({0, 0}, 24);
  double sum = 0;
  for (int i = 0; i < 24; ++i) sum += 1e-9 * std::cosh(0.5 * i);
  EXPECT_GE(apart[0], 0.999 * sum);
  EXPECT_LE(apart[0], 1.5 * sum);
}

/// A long step of x'' = x + 1 from rest, which makes errors as s^order. What was apart before is below the
/// last digits of the push, beside which it tells nothing.
TEST(Separation, ErrorsOfALongStepGrowInItWhateverWasApartBefore) {
  constexpr double h = 14, made = 1e-3;
  const RightHandSide pushed = pulled_by(1, 1);
  const auto apart = [&](const std::vector<double>& before) {
    Separation separation(pushed, before);
    const std::vector<double> sizes{made, made};
    take_steps(pushed, {0, 0}, h, 1, {}, [&](const MotionPiece& step) {
      StepTerms terms(2);
      terms.take(step);
      separation.follow(step, terms, {.sizes = sizes, .sides = sizes, .of_series = sizes});
    });
    return separation.in_last_step()[0];
  };
  double grown = 0, term = made;  // of what comes as s^order
  for (unsigned k = 1; term > 1e-9 * made; term *= h / (order + k++)) grown += term;
  const double from_nothing = apart({0, 0});
  EXPECT_GT(from_nothing, grown);
  for (const double before : {1e-80, 1e-30})
    EXPECT_NEAR(apart({before, 0}), from_nothing, 1e-3 * from_nothing) << before;
}

TEST(Separation, ComesFromParametersThatAreMoved) {
  const double k = 1 + 1e-9;
  const auto apart = Steps{.k = 1, .k_of_reference = k}.apart({0, 0}, 8);
  EXPECT_NEAR(apart[0], std::cosh(std::sqrt(k) * 4) - std::cosh(4), 1e-3 * apart[0]);
}

/// An ulp of x is lost in y + e where y is large, and both computations would be the same.
TEST(Separation, IsSeenWhereItIsLessThanAnUlp) {
  EXPECT_GT((Steps{.k = 1, .k_of_reference = 1}.apart({0x1p-60, 0}, 6)[0]), 0x1p-53);
  const Steps enlarged{.k = 1, .k_of_reference = 1, .scale = Separation::Scale::enlarged};
  const auto apart = enlarged.apart({1e-25, 0}, 24);
  EXPECT_NEAR(apart[0], 1e-25 * std::cosh(12), 1e-3 * apart[0]);
}

TEST(Separation, OfALostMotionIsAsLargeAsTheOneThatGoesAway) {
  const Steps steps{.k = 1, .k_of_reference = 1, .start = {1, -1}};  // e^-t, beside it e^t
  const auto apart = steps.apart({1e-3, 0}, 20);
  EXPECT_NEAR(apart[0], 1e-3 * std::cosh(10), 1e-3 * apart[0]);
}

TEST(Separation, OfALostMotionThatComesBackIsAsLargeAsBothAre) {
  const Steps steps{.k = -1, .k_of_reference = -1, .start = {1, 0}};  // 1.5 cos t beside cos t
  const auto apart = steps.apart({0.5, 0}, 200);
  EXPECT_LT(apart[0], 0.6);
}

TEST(Separation, StaysWhereTheOriginalHasNoValues) {
  RightHandSide original = pulled_by(1);
  original.expansion = [](double, auto, unsigned, auto) { return Evaluation::nonfinite; };
  Separation separation(original, {1e-9, 0});
  const std::vector<double> rows(2 * (order + 1), 1.0);
  follow(separation, {.t = 0, .h = 1, .rows = rows, .order = order, .defect = {}});
  EXPECT_EQ(separation.in_last_step()[0], 1e-9);
}

TEST(Separation, IsWithinConstraints) {
  RightHandSide original = pulled_by(-1);
  original.project = [](double, std::span<double> y) {
    y[0] = 1;
    return true;
  };
  Separation separation(original, {1e-3, 1e-9});
  std::vector<double> c(2 * (order + 1));
  ASSERT_EQ(original.expansion(0, std::vector<double>{1, 0}, order, c), Evaluation::ok);
  follow(separation, {.t = 0, .h = 1e-3, .rows = c, .order = order, .defect = {}});
  EXPECT_LT(separation.in_last_step()[0], 1e-11);
  EXPECT_NEAR(separation.in_last_step()[1], 1e-9, 1e-12);
}

}  // namespace
}  // namespace qdot
