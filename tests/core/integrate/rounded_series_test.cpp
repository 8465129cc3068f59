#include "core/integrate/rounded_series.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace qdot::rounded_series_test {
namespace {

constexpr double stiffness = 20;
constexpr unsigned order = 12, first_in_doubles = 6;

/// x'' = stiffness x - force
template <class Number>
std::vector<Number> series(const Number& x, const Number& v, const Number& force, unsigned to) {
  std::vector<Number> c(2 * (to + 1));
  c[0] = x;
  c[to + 1] = v;
  for (unsigned k = 1; k <= to; ++k) {
    c[k] = c[to + k] / Number(k);
    c[to + 1 + k] = (Number(stiffness) * c[k - 1] - (k == 1 ? force : Number(0.0))) / Number(k);
  }
  return c;
}

RightHandSide saddle(double force) {
  RightHandSide system;
  system.expansion = [force](double, std::span<const double> y, unsigned to, std::span<double> c) {
    std::ranges::copy(series(y[0], y[1], force, to), c.begin());
    return Evaluation::ok;
  };
  return system;
}

/// Low coefficients in double-doubles, the others in doubles, as MixedExpansion has them.
std::vector<DoubleDouble> mixed(const DoubleDouble& x, const DoubleDouble& force) {
  std::vector<DoubleDouble> c = series(x, DoubleDouble(0.0), force, order);
  const std::vector<double> others = series(x.high, 0.0, force.high, order);
  for (unsigned k = first_in_doubles; k <= order; ++k) {
    c[k] = others[k];
    c[order + 1 + k] = others[order + 1 + k];
  }
  return c;
}

TEST(RoundedSeries, TellsWhatGrowsFromABalanceOfForces) {
  const DoubleDouble x(0.3, 1e-18), force = DoubleDouble(stiffness) * DoubleDouble(0.3);
  const std::vector<DoubleDouble> c = mixed(x, force), exact = series(x, DoubleDouble(0.0), force, order);
  const RightHandSide in_doubles = saddle(force.high);
  RoundedSeries rounded(in_doubles, first_in_doubles);
  const double of_forces[]{1e-15};
  rounded.take(0, c, order, of_forces, 10.0);
  const double h = rounded.told_part(10.0);
  EXPECT_LT(h * std::sqrt(stiffness), 2);
  EXPECT_GT(h * std::sqrt(stiffness), 0.5);
  ASSERT_GT(std::abs((exact[first_in_doubles] - c[first_in_doubles]).value()), 0);
  for (const double length : {h, 10.0}) {
    double off = 0;
    for (unsigned k = first_in_doubles; k < first_in_doubles + 2; ++k)
      off = std::max(off, std::pow(length, k) * std::abs((exact[k] - c[k]).value()));
    EXPECT_GE(rounded.off(0, length), off);
  }
}

TEST(RoundedSeries, HoldsNoStepOfWhatMovesAlike) {
  const RightHandSide in_doubles = saddle(0);
  RoundedSeries rounded(in_doubles, first_in_doubles);
  const double of_forces[]{0.0};
  rounded.take(0, mixed(DoubleDouble(0.0), DoubleDouble(0.0)), order, of_forces, 10.0);
  EXPECT_EQ(rounded.told_part(10.0), 10.0);
  EXPECT_EQ(rounded.off(0, 10.0), 0);
}

}  // namespace
}  // namespace qdot::rounded_series_test
