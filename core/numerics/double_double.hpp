#pragma once
// A number as the unevaluated sum of two doubles, 106 bits: what is left after doubles cancel (M + m - m of a
// light cart) still has its digits. Each operation is within 10 u^2 of the exact result, u = 2^-53, relative.
// Source: Joldes, Muller, Popescu, Tight and rigorous error bounds for basic building blocks of double-word
// arithmetic, ACM TOMS 44 (2017): algorithms 6 (sum), 12 (product), 17 (quotient).

#include <cmath>

namespace qdot {

struct DoubleDouble {
  double high{};
  double low{};  ///< |low| <= u |high|

  DoubleDouble() = default;
  DoubleDouble(double value) : high(value) {}  // implicit: a double is one
  DoubleDouble(double high_part, double low_part) : high(high_part), low(low_part) {}
  [[nodiscard]] static DoubleDouble of(long double value) {
    const auto high = static_cast<double>(value);
    return {high, static_cast<double>(value - high)};
  }
  [[nodiscard]] double value() const { return high + low; }
  [[nodiscard]] long double extended() const { return static_cast<long double>(high) + low; }
};

/// a + b exactly.
inline DoubleDouble two_sum(double a, double b) {
  const double sum = a + b;
  const double other = sum - a;
  return {sum, (a - (sum - other)) + (b - other)};
}
/// The same for |a| >= |b|.
inline DoubleDouble fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}
/// a b exactly.
inline DoubleDouble two_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

inline DoubleDouble operator-(const DoubleDouble& a) { return {-a.high, -a.low}; }
inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble high = two_sum(a.high, b.high);
  const DoubleDouble low = two_sum(a.low, b.low);
  const DoubleDouble sum = fast_two_sum(high.high, high.low + low.high);
  return fast_two_sum(sum.high, low.low + sum.low);
}
inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble product = two_product(a.high, b.high);
  const double low = std::fma(a.low, b.high, std::fma(a.high, b.low, a.low * b.low));
  return fast_two_sum(product.high, product.low + low);
}
inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double first = a.high / b.high;
  const DoubleDouble rest = a - b * DoubleDouble(first);
  return fast_two_sum(first, rest.high / b.high);
}

[[nodiscard]] inline DoubleDouble sqrt(const DoubleDouble& a) {
  if (a.high <= 0) return std::sqrt(a.high);
  const double root = std::sqrt(a.high);
  const DoubleDouble square = two_product(root, root);
  return fast_two_sum(root, (a - square).high / (2 * root));
}

}  // namespace qdot
