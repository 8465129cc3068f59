#pragma once
// x'' = k x + push by its series, and references that take steps of it.

#include <gtest/gtest.h>

#include <vector>

#include "core/integrate/run.hpp"

namespace qdot::integrate_test {

inline constexpr unsigned order = 22;

/// Series of y = (x, x') for x'' = k x + push.
inline RightHandSide pulled_by(double k, double push = 0) {
  RightHandSide system;
  system.dimension = 2;
  system.expansion = [k, push](double, std::span<const double> y, unsigned highest, std::span<double> c) {
    const auto x = c.first(highest + 1), v = c.subspan(highest + 1);
    x[0] = y[0];
    v[0] = y[1];
    for (unsigned i = 0; i < highest; ++i) {
      x[i + 1] = v[i] / (i + 1);
      v[i + 1] = (i == 0 ? k * x[0] + push : k * x[i]) / (i + 1);
    }
    return Evaluation::ok;
  };
  return system;
}

/// `follow` gets each of `count` steps of length h from y.
template <class Follow>
void take_steps(const RightHandSide& system, std::vector<double> y, double h, int count,
                std::span<const double> defect, Follow follow) {
  std::vector<double> c(2 * (order + 1));
  for (int i = 0; i < count; ++i) {
    ASSERT_EQ(system.expansion(i * h, y, order, c), Evaluation::ok);
    follow(MotionPiece{.t = i * h, .h = h, .rows = c, .order = order, .defect = defect, .rounding = {}});
    for (std::size_t j = 0; j < 2; ++j) {
      const auto row = std::span(c).subspan(j * (order + 1), order + 1);
      y[j] = 0;
      for (std::size_t n = order + 1; n-- > 0;) y[j] = y[j] * h + row[n];
    }
  }
}

}  // namespace qdot::integrate_test
