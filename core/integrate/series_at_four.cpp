#include "core/integrate/series_at_four.hpp"

#include "core/numerics/instruction_set.hpp"

namespace qdot {
namespace {

using Four [[gnu::vector_size(32)]] = double;

/// So many rows as sum_series() does it: odd and even powers apart, and a last odd order first.
template <std::size_t count>
[[gnu::always_inline]] inline void sum_rows_at_four(const double* c, std::size_t order, const Four& s,
                                                    double* sums) {
  const Four s2 = s * s;
  Four odd[count]{}, even[count]{};
  std::size_t k = order;
  if (k % 2 == 1) {
    for (std::size_t i = 0; i < count; ++i) odd[i] += c[i * (order + 1) + k];
    --k;
  }
  for (; k > 0; k -= 2) {
#pragma GCC unroll 2
    for (std::size_t i = 0; i < count; ++i) {
      const double* const row = c + i * (order + 1);
      odd[i] = odd[i] * s2 + row[k - 1];
      even[i] = even[i] * s2 + row[k];
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Four sum = (odd[i] + even[i] * s) * s;
    __builtin_memcpy(sums + 4 * i, &sum, sizeof sum);
  }
}

[[gnu::always_inline]] inline void sum_at_four(const double* c, std::size_t order, const double* times,
                                               double* sums, std::size_t rows) {
  Four s;
  __builtin_memcpy(&s, times, sizeof s);
  std::size_t i = 0;
  for (; i + 2 <= rows; i += 2) sum_rows_at_four<2>(c + i * (order + 1), order, s, sums + 4 * i);
  if (i < rows) sum_rows_at_four<1>(c + i * (order + 1), order, s, sums + 4 * i);
}

// Without fused multiply-adds: both give the same bits.
#ifdef __x86_64__
[[gnu::target("avx2")]]
#endif
void sum_with_avx2(const double* c, std::size_t order, const double* times,
                                           double* sums, std::size_t rows) {
  sum_at_four(c, order, times, sums, rows);
}

}  // namespace

void sum_series_at_four(const double* c, std::size_t order, const double* s, std::span<double> sums) {
  static const bool is_fast = has_avx2();
  if (!is_fast) return sum_series_at_four_plainly(c, order, s, sums);
  sum_with_avx2(c, order, s, sums.data(), sums.size() / 4);
}

void sum_series_at_four_plainly(const double* c, std::size_t order, const double* s, std::span<double> sums) {
  sum_at_four(c, order, s, sums.data(), sums.size() / 4);
}

}  // namespace qdot
