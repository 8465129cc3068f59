#pragma once
// Powers with whole exponents of numbers that have *, and square() that knows both factors are the same.

namespace qdot {

/// u^exponent, exponent >= 1, by squaring: 2 log2(exponent) products at most.
/// Source: Knuth, The Art of Computer Programming 2 (1997), 4.6.3.
template <class T>
[[nodiscard]] T whole_power(const T& u, int exponent) {
  T result = u;
  T factor = u;
  bool first = true;
  for (int e = exponent; e > 0; e /= 2) {
    if (e % 2 == 1) {
      result = first ? factor : result * factor;
      first = false;
    }
    if (e > 1) factor = square(factor);
  }
  return result;
}

/// x^k; 1 where k is 0.
[[nodiscard]] constexpr double whole_power(double x, unsigned k) {
  double result = 1;
  for (; k > 0; k /= 2, x *= x) {
    if (k % 2 == 1) result *= x;
  }
  return result;
}

}  // namespace qdot
