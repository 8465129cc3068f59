#pragma once
// A number as the unevaluated sum of two doubles, 106 bits: what is left after doubles cancel (M + m - m of a
// light cart) still has its digits. A sum is within 3 u^2 of the exact result, a product within 5 u^2, a
// quotient within 15 u^2, u = 2^-53, relative.
//
// The bits are the same with and without fused multiply-adds: they serve the one purpose of finding the
// rounding error of a product, which Dekker's splitting finds as well. Products below 2^-960, where that
// error may underflow, are taken without it.
//
// Everything here is always inlined, so that a source compiled for another instruction set cannot lend its
// copy to the others.
//
// Sources: Joldes, Muller, Popescu, Tight and rigorous error bounds for basic building blocks of double-word
// arithmetic, ACM TOMS 44 (2017): algorithms 6 (sum), 10 (product), 17 (quotient); Dekker, A floating-point
// technique for extending the available precision, Numer. Math. 18 (1971) 224.

#include <bit>
#include <cmath>
#include <cstdint>

namespace qdot {

struct DoubleDouble {
  double high{};
  double low{};  ///< |low| <= u |high|

  [[gnu::always_inline]] constexpr DoubleDouble() = default;
  // Implicit: a double is one.
  [[gnu::always_inline]] constexpr DoubleDouble(double value) : high(value) {}
  [[gnu::always_inline]] constexpr DoubleDouble(double high_part, double low_part)
      : high(high_part), low(low_part) {}
  [[nodiscard]] static DoubleDouble of(long double value) {
    const auto high = static_cast<double>(value);
    return {high, static_cast<double>(value - high)};
  }
  [[nodiscard]] double value() const { return high + low; }
  [[nodiscard]] long double extended() const { return static_cast<long double>(high) + low; }
};

/// a + b exactly.
[[gnu::always_inline]] inline DoubleDouble two_sum(double a, double b) {
  const double sum = a + b;
  const double other = sum - a;
  return {sum, (a - (sum - other)) + (b - other)};
}
/// The same for |a| >= |b|.
[[gnu::always_inline]] inline DoubleDouble fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// Products smaller than this count without their rounding error.
inline constexpr double least_product = 0x1p-960;

/// The leading 26 bits of x; the rest, x less these, has 26 as well.
[[gnu::always_inline]] inline double leading_half(double x) {
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(x) + (std::uint64_t{1} << 26)) &
                               ~((std::uint64_t{1} << 27) - 1));
}

/// a b exactly, where it is neither tiny nor infinite.
[[gnu::always_inline]] inline DoubleDouble two_product(double a, double b) {
  const double product = a * b;
#ifdef __FMA__
  const double error = __builtin_fma(a, b, -product);
#else
  const double a1 = leading_half(a), a2 = a - a1;
  const double b1 = leading_half(b), b2 = b - b1;
  const double error = ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2;
#endif
  return {product, __builtin_fabs(product) < least_product ? 0.0 : error};
}

[[gnu::always_inline]] inline DoubleDouble operator-(const DoubleDouble& a) { return {-a.high, -a.low}; }
[[gnu::always_inline]] inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble high = two_sum(a.high, b.high);
  const DoubleDouble low = two_sum(a.low, b.low);
  const DoubleDouble sum = fast_two_sum(high.high, high.low + low.high);
  return fast_two_sum(sum.high, low.low + sum.low);
}
[[gnu::always_inline]] inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
  return a + -b;
}
[[gnu::always_inline]] inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble product = two_product(a.high, b.high);
  return fast_two_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}
[[gnu::always_inline]] inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
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

[[gnu::always_inline]] inline DoubleDouble abs(const DoubleDouble& a) { return a.high < 0 ? -a : a; }
[[gnu::always_inline]] inline bool is_finite(const DoubleDouble& a) {
  return __builtin_isfinite(a.high) && __builtin_isfinite(a.low);
}
/// a 2^exponent.
[[nodiscard]] inline DoubleDouble scaled(const DoubleDouble& a, int exponent) {
  return {std::ldexp(a.high, exponent), std::ldexp(a.low, exponent)};
}

}  // namespace qdot
