#pragma once
// Logarithm and power of two to five digits, by sums: enough for the length of a step, and the same bits on
// every machine.

#include <bit>
#include <cmath>
#include <cstdint>

namespace qdot {

/// std::frexp, without a call where x is a normal number above 0.
[[nodiscard]] inline double mantissa_of(double x, int& exponent) {
  const auto bits = std::bit_cast<std::uint64_t>(x), biased = bits >> 52U;
  if (biased - 1 >= 2046) return std::frexp(x, &exponent);
  exponent = static_cast<int>(biased) - 1022;
  constexpr std::uint64_t digits = (std::uint64_t{1} << 52U) - 1, of_half = std::uint64_t{1022} << 52U;
  return std::bit_cast<double>((bits & digits) | of_half);
}

/// std::ldexp, without a call where 2^k is a normal number; x is about 1.
[[nodiscard]] inline double scaled_by_two(double x, int k) {
  if (k < -1000 || k > 1000) return std::ldexp(x, k);
  return x * std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52U);
}

/// log2 x to five digits, for x > 0: sum of s^(2i+1)/(2i+1) with s = (m - a)/(m + a), a^2 = 1/2.
[[nodiscard]] inline double rough_log2(double x) {
  constexpr double a = 0.70710678118654752, two_over_ln2 = 2.8853900817779268;
  int exponent{};
  const double m = mantissa_of(x, exponent);
  const double s = (m - a) / (m + a), s2 = s * s;
  return exponent - 0.5 + two_over_ln2 * s * (1 + s2 * (1.0 / 3 + s2 * (1.0 / 5)));
}

/// 2^x to five digits.
[[nodiscard]] inline double rough_exp2(double x) {
  constexpr double ln2 = 0.69314718055994531;
  const int whole = static_cast<int>(x < 0 ? x - 0.5 : x + 0.5);  // |x| < 2200
  const double f = (x - whole) * ln2;
  const double sum = 1 + f * (1 + f * (1.0 / 2 + f * (1.0 / 6 + f * (1.0 / 24 + f * (1.0 / 120)))));
  return scaled_by_two(sum, whole);
}

}  // namespace qdot
