#pragma once
// Values and slopes of Taylor polynomials from their coefficients, by Horner's rule.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>

namespace qdot {

enum class SeriesSum { value, slope, largest_slope };

/// sum_{k>=1} c_k s^k of so many rows of coefficients, or its derivative, or sum k |c_k| s^(k-1), side by
/// side and even and odd powers apart, as each sum alone would wait for itself.
template <SeriesSum sum_of, std::size_t count>
void sum_series(const double* c, std::size_t order, double s, double* sums) {
  using Two [[gnu::vector_size(16)]] = double;
  constexpr bool of_magnitudes = sum_of == SeriesSum::largest_slope;
  constexpr bool of_slopes = sum_of == SeriesSum::slope || of_magnitudes;
  const auto row = [&](std::size_t i) { return c + i * (order + 1); };
  const Two s2{s * s, s * s};
  std::array<Two, count> sum{};
  std::size_t k = order;
  if (k % 2 == 1) {
    const double factor = of_slopes ? static_cast<double>(k) : 1.0;
    for (std::size_t i = 0; i < count; ++i)
      sum[i][0] = factor * (of_magnitudes ? std::abs(row(i)[k]) : row(i)[k]);
    --k;
  }
  Two powers{static_cast<double>(k) - 1, static_cast<double>(k)};
  for (; k > 0; k -= 2, powers -= 2.0) {
#pragma GCC unroll 4
    for (std::size_t i = 0; i < count; ++i) {
      Two pair;
      std::memcpy(&pair, row(i) + k - 1, sizeof pair);
      if (of_magnitudes) pair = pair < 0 ? -pair : pair;
      if (of_slopes) pair *= powers;
      sum[i] = sum[i] * s2 + pair;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    sums[i] = sum[i][0] + sum[i][1] * s;
    if (sum_of == SeriesSum::value) sums[i] *= s;
  }
}

/// The same for as many rows as there are sums.
template <SeriesSum sum_of>
void sum_all_series(const double* c, std::size_t order, double s, std::span<double> sums) {
  const std::size_t n = sums.size(), row = order + 1;
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) sum_series<sum_of, 4>(c + i * row, order, s, sums.data() + i);
  for (; i + 2 <= n; i += 2) sum_series<sum_of, 2>(c + i * row, order, s, sums.data() + i);
  for (; i < n; ++i) sum_series<sum_of, 1>(c + i * row, order, s, sums.data() + i);
}

}  // namespace qdot
