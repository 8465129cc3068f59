// Enclosed solutions against the solutions that systems were made for.

#include "core/numerics/enclosed_system.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/random.hpp"

namespace qdot {
namespace {

/// M x = b for an x that is known: M and x are small whole numbers, so that b is exact.
struct Problem {
  std::size_t n;
  std::vector<double> m, x, b;

  Problem(test::Random& random, std::size_t size) : n(size) {
    for (std::size_t i = 0; i < n * n; ++i) m.push_back(std::round(random.real(-50, 50)));
    for (std::size_t i = 0; i < n; ++i) x.push_back(std::round(random.real(-50, 50)));
    for (std::size_t i = 0; i < n; ++i) {
      b.push_back(0);
      for (std::size_t j = 0; j < n; ++j) b[i] += m[i * n + j] * x[j];
    }
  }
};

/// Balls of a radius around places near the numbers, which hold them.
std::vector<Ball> around(test::Random& random, const std::vector<double>& numbers, double radius) {
  std::vector<Ball> balls;
  for (const double number : numbers) balls.emplace_back(number + random.real(-radius, radius), 2 * radius);
  return balls;
}

TEST(EnclosedSystem, HoldsTheSolution) {
  test::Random random(3);
  int found = 0;
  for (int i = 0; i < 2000; ++i) {
    const Problem problem(random, 1 + static_cast<std::size_t>(i) % 8);
    const double radius = i % 3 == 0 ? 0 : std::pow(10, random.real(-20, -3));
    const std::vector<Ball> m = around(random, problem.m, radius);
    std::vector<Ball> x = around(random, problem.b, radius);
    solve_linear(problem.n, m, std::span(x));
    if (!x[0].is_finite()) continue;
    ++found;
    double width = 0;
    for (std::size_t k = 0; k < problem.n; ++k) {
      EXPECT_TRUE((x[k] - Ball(problem.x[k])).contains_zero()) << i;
      width = std::max(width, x[k].radius);
    }
    EXPECT_LT(width, 1e-22 + 1e7 * radius) << i;
  }
  EXPECT_GT(found, 1900);
}

TEST(EnclosedSystem, OfAMatrixThatMayHaveNoInverseIsUnbounded) {
  const std::vector<Ball> m{Ball(1), Ball(2), Ball(2), Ball(DoubleDouble(4), 1e-9)};
  std::vector<Ball> b{Ball(1), Ball(3)};
  solve_linear(2, m, std::span(b));
  EXPECT_FALSE(b[0].is_finite());
  EXPECT_FALSE(b[1].is_finite());
}

TEST(EnclosedSystem, SolvesForEachRightHandSide) {
  const std::vector<Ball> m{Ball(2), Ball(1), Ball(1), Ball(3)};
  std::vector<Ball> b{Ball(5), Ball(10), Ball(4), Ball(7)};
  solve_linear(2, m, std::span(b));
  const std::vector<double> x{1, 3, 1, 2};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(b[k].value(), x[k], 1e-30) << k;
}

TEST(EnclosedSystem, OfIntervalsHoldsTheSolutionsOfTheirEnds) {
  const std::vector<Interval> m{{2, 2.001}, 1, 1, {3, 3.001}};
  std::vector<Interval> x{{5, 5.01}, 10};
  solve_linear(2, m, std::span(x));
  for (const double a : {2.0, 2.001})
    for (const double d : {3.0, 3.001})
      for (const double b : {5.0, 5.01}) {
        EXPECT_TRUE(x[0].contains((b * d - 10) / (a * d - 1)));
        EXPECT_TRUE(x[1].contains((10 * a - b) / (a * d - 1)));
      }
  EXPECT_LT(x[0].width(), 0.02);
}

TEST(EnclosedSystem, OfIntervalsThatMayHaveNoInverseIsAnyNumber) {
  const std::vector<Interval> m{1, 2, 2, {4 - 1e-9, 4 + 1e-9}};
  std::vector<Interval> x{1, 3};
  solve_linear(2, m, std::span(x));
  EXPECT_TRUE(x[0].contains(Interval::whole()));
}

}  // namespace
}  // namespace qdot
