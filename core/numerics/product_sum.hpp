#pragma once
// Sums of products of enclosed numbers, with one bound of all their roundings instead of one an operation.
// Source: Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., section 3.1.

#include <algorithm>
#include <cmath>

#include "core/numerics/ball.hpp"
#include "core/numerics/constants.hpp"
#include "core/numerics/interval.hpp"

namespace qdot {

/// Of numbers that are all finite; where one is not, nothing is known of the total.
template <class T>
class ProductSum;

template <>
class ProductSum<Interval> {
 public:
  void add(const Interval& a, const Interval& b) {
    const double products[4]{a.lower * b.lower, a.lower * b.upper, a.upper * b.lower, a.upper * b.upper};
    const double low = std::min(std::min(products[0], products[1]), std::min(products[2], products[3]));
    const double high = std::max(std::max(products[0], products[1]), std::max(products[2], products[3]));
    lower_ += low;
    upper_ += high;
    size_ += std::max(-low, high);
    seen_ += (products[0] + products[1]) + (products[2] + products[3]);
    count_ += 1;
  }
  /// The whole line where an overflow or an infinite end came in, which the caller looks at once more.
  [[nodiscard]] Interval total() const {
    const double error = ((count_ + 2) * 0x1p-53 * size_) * (1 + 0x1p-40) + count_ * 1e-323;
    if (!std::isfinite(seen_) || !std::isfinite(error)) return Interval::whole();
    return Interval(lower_, upper_) + Interval(-error, error);
  }

 private:
  double lower_{}, upper_{}, size_{}, count_{};
  double seen_{};  ///< not finite after what is not
};

/// In double-double the unit is 2^-104 (Joldes, Muller, Popescu, ACM TOMS 44 (2017)).
template <>
class ProductSum<Ball> {
 public:
  void add(const Ball& a, const Ball& b) {
    const double x = std::abs(a.middle.high), y = std::abs(b.middle.high);
    sum_ = sum_ + a.middle * b.middle;
    size_ += x * y;
    radius_ += x * b.radius + a.radius * (y + b.radius);
    count_ += 1;
  }
  [[nodiscard]] Ball total() const {
    constexpr double smallest_exact = 1e-250;
    const double rounding = (count_ + 2) * 0x1p-101 * size_ + (size_ < smallest_exact ? count_ * 1e-300 : 0);
    const double radius = (radius_ + rounding) * (1 + 0x1p-40);
    return std::isfinite(sum_.high) && std::isfinite(radius) ? Ball(sum_, radius) : Ball({}, infinity);
  }

 private:
  DoubleDouble sum_;
  double size_{}, radius_{}, count_{};
};

}  // namespace qdot
