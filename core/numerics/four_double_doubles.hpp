#pragma once
// Four double-doubles side by side, with the bits that each alone has (double_double.hpp). For sources that
// are compiled for one instruction set each: always inlined, so that none lends its copy to another.

#include <cstring>

#include "core/numerics/double_double.hpp"
#ifdef __FMA__
#include <immintrin.h>
#endif

namespace qdot {

using FourDoubles [[gnu::vector_size(32)]] = double;
using FourBits [[gnu::vector_size(32)]] = long long;

#ifndef __FMA__
[[gnu::always_inline]] inline FourDoubles leading_halves(const FourDoubles& x) {
  return (FourDoubles)(((FourBits)x + (1LL << 26)) & ~((1LL << 27) - 1));
}
#endif

/// What a b lacks of the exact product, as two_product has it.
[[gnu::always_inline]] inline FourDoubles product_error(const FourDoubles& a, const FourDoubles& b,
                                                        const FourDoubles& product) {
#ifdef __FMA__
  const FourDoubles error = _mm256_fmsub_pd(a, b, product);
#else
  const FourDoubles a1 = leading_halves(a), a2 = a - a1;
  const FourDoubles b1 = leading_halves(b), b2 = b - b1;
  const FourDoubles error = ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2;
#endif
  const FourBits is_tiny = (product < least_product) & (product > -least_product);
  return (FourDoubles)(~is_tiny & (FourBits)error);
}

struct FourDoubleDoubles {
  FourDoubles high{}, low{};
};

[[gnu::always_inline]] inline FourDoubleDoubles two_sums(const FourDoubles& a, const FourDoubles& b) {
  const FourDoubles sum = a + b, other = sum - a;
  return {sum, (a - (sum - other)) + (b - other)};
}
[[gnu::always_inline]] inline FourDoubleDoubles fast_two_sums(const FourDoubles& a, const FourDoubles& b) {
  const FourDoubles sum = a + b;
  return {sum, b - (sum - a)};
}
[[gnu::always_inline]] inline FourDoubleDoubles operator+(const FourDoubleDoubles& a,
                                                          const FourDoubleDoubles& b) {
  const FourDoubleDoubles high = two_sums(a.high, b.high), low = two_sums(a.low, b.low);
  const FourDoubleDoubles sum = fast_two_sums(high.high, high.low + low.high);
  return fast_two_sums(sum.high, low.low + sum.low);
}
[[gnu::always_inline]] inline FourDoubleDoubles operator*(const FourDoubleDoubles& a,
                                                          const FourDoubleDoubles& b) {
  const FourDoubles product = a.high * b.high, error = product_error(a.high, b.high, product);
  return fast_two_sums(product, error + (a.high * b.low + a.low * b.high));
}

}  // namespace qdot
