#pragma once
// The values that a quantity takes during a step: a pair of bounds, found in plain doubles. They need not be
// tight to the last digit, since whoever uses them widens the result (remainder.cpp).

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numerics/constants.hpp"
#include "core/numerics/function.hpp"

namespace qdot::taylor {

struct Range {
  double lower{-infinity};
  double upper{infinity};

  [[nodiscard]] double magnitude() const { return std::max(std::abs(lower), std::abs(upper)); }
  [[nodiscard]] bool contains_zero() const { return !(lower > 0 || upper < 0); }
  /// The least magnitude; 0 where 0 is inside.
  [[nodiscard]] double least_magnitude() const {
    return contains_zero() ? 0 : std::min(std::abs(lower), std::abs(upper));
  }
};

/// Bounds that are no numbers say nothing.
[[nodiscard]] inline Range range(double lower, double upper) {
  return lower <= upper ? Range{lower, upper} : Range{};
}

[[nodiscard]] inline Range operator+(const Range& a, const Range& b) {
  return range(a.lower + b.lower, a.upper + b.upper);
}
[[nodiscard]] inline Range operator+(const Range& a, double b) { return range(a.lower + b, a.upper + b); }
[[nodiscard]] inline Range operator-(const Range& a, double b) { return range(a.lower - b, a.upper - b); }

[[nodiscard]] inline Range operator*(double factor, const Range& a) {
  return factor < 0 ? range(factor * a.upper, factor * a.lower) : range(factor * a.lower, factor * a.upper);
}

/// A bound 0 times an infinite one: what is inside may come to anything of the sign of the other products.
[[nodiscard]] inline Range operator*(const Range& a, const Range& b) {
  const double products[]{a.lower * b.lower, a.lower * b.upper, a.upper * b.lower, a.upper * b.upper};
  double lower = infinity, upper = -infinity;
  for (const double product : products) {
    const bool is_open = std::isnan(product);
    lower = std::min(lower, is_open ? 0 : product);
    upper = std::max(upper, is_open ? 0 : product);
  }
  const bool is_known =
      lower < 0 || upper > 0 || std::ranges::none_of(products, [](double p) { return std::isnan(p); });
  return is_known ? Range{lower, upper} : Range{};
}

[[nodiscard]] inline Range square(const Range& a) {
  const double most = a.magnitude(), least = a.least_magnitude();
  return range(least * least, most * most);
}

/// A sum of ranges. Its bounds are rounded by as much as what each of them is the sum of is large: 1 + u^8 is
/// not less than 1, however large u^8 may be elsewhere.
class RangeOfSum {
 public:
  explicit RangeOfSum(double constant)
      : sum_{constant, constant}, of_lower_(std::abs(constant)), of_upper_(std::abs(constant)) {}

  void add(const Range& term) {
    sum_ = sum_ + term;
    of_lower_ += std::abs(term.lower);
    of_upper_ += std::abs(term.upper);
  }
  [[nodiscard]] Range rounded_outwards() const {
    constexpr double share = 64 * std::numeric_limits<double>::epsilon();
    return range(std::isinf(sum_.lower) ? sum_.lower : sum_.lower - share * of_lower_,
                 std::isinf(sum_.upper) ? sum_.upper : sum_.upper + share * of_upper_);
  }

 private:
  Range sum_;
  double of_lower_{}, of_upper_{};  ///< sums of magnitudes
};

[[nodiscard]] inline Range operator/(const Range& a, const Range& b) {
  return b.contains_zero() ? Range{} : a * range(1 / b.upper, 1 / b.lower);
}

/// Of a function that does not fall.
[[nodiscard]] inline Range rising(Function function, const Range& a) {
  return range(evaluate(function, a.lower), evaluate(function, a.upper));
}

/// sin(a + shift pi/2)
[[nodiscard]] inline Range sine(const Range& a, double shift) {
  constexpr double exactly = 1e6;  // beyond, the quadrant is not looked for
  if (!(a.magnitude() < exactly)) return {-1, 1};
  const double begin = evaluate(Function::sin, a.lower + shift * (pi / 2));
  const double end = evaluate(Function::sin, a.upper + shift * (pi / 2));
  Range result{std::min(begin, end), std::max(begin, end)};
  // Turns at which the sine has its extrema; a little is added where they may lie just outside.
  const double from = (a.lower / (pi / 2) + shift) / 4 - 1e-9, to = (a.upper / (pi / 2) + shift) / 4 + 1e-9;
  if (std::floor(to - 0.25) >= std::ceil(from - 0.25)) result.upper = 1;
  if (std::floor(to + 0.25) >= std::ceil(from + 0.25)) result.lower = -1;
  return result;
}

}  // namespace qdot::taylor
