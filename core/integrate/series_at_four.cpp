#include "core/integrate/series_at_four.hpp"

namespace qdot {
namespace {

using Four [[gnu::vector_size(32)]] = double;

/// As sum_series() does it: odd and even powers apart, and a last odd order first.
[[gnu::always_inline]] inline void sum_at_four(const double* c, std::size_t order, const double* times,
                                               double* sums, std::size_t rows) {
  Four s;
  __builtin_memcpy(&s, times, sizeof s);
  const Four s2 = s * s;
  for (std::size_t i = 0; i < rows; ++i, c += order + 1, sums += 4) {
    Four odd{}, even{};
    std::size_t k = order;
    if (k % 2 == 1) {
      odd = Four{c[k], c[k], c[k], c[k]};
      --k;
    }
    for (; k > 0; k -= 2) {
      odd = odd * s2 + c[k - 1];
      even = even * s2 + c[k];
    }
    const Four sum = (odd + even * s) * s;
    __builtin_memcpy(sums, &sum, sizeof sum);
  }
}

// Without fused multiply-adds: both give the same bits.
[[gnu::target("avx2")]] void sum_with_avx2(const double* c, std::size_t order, const double* times,
                                           double* sums, std::size_t rows) {
  sum_at_four(c, order, times, sums, rows);
}

}  // namespace

void sum_series_at_four(const double* c, std::size_t order, const double* s, std::span<double> sums) {
  static const bool has_avx2 = __builtin_cpu_supports("avx2");
  if (!has_avx2) return sum_series_at_four_plainly(c, order, s, sums);
  sum_with_avx2(c, order, s, sums.data(), sums.size() / 4);
}

void sum_series_at_four_plainly(const double* c, std::size_t order, const double* s, std::span<double> sums) {
  sum_at_four(c, order, s, sums.data(), sums.size() / 4);
}

}  // namespace qdot
