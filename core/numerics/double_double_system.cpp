#include "core/numerics/double_double_system.hpp"

#include <algorithm>

#include "core/numerics/lost_pivot.hpp"

namespace qdot {

bool factor_linear(std::size_t n, std::span<DoubleDouble> m, RowOrder& row) noexcept {
  std::array<double, largest_system> scale{};
  for (std::size_t i = 0; i < n * n; ++i) scale[i / n] = std::max(scale[i / n], std::abs(m[i].high));
  const double lost = 4 * static_cast<double>(n) * 0x1p-104;
  for (std::size_t i = 0; i < n; ++i) row[i] = i;
  for (std::size_t k = 0; k < n; ++k) {
    const auto weight = [&](std::size_t i) { return std::abs(m[row[i] * n + k].high) / scale[row[i]]; };
    std::size_t best = k;
    for (std::size_t i = k + 1; i < n; ++i) {
      if (weight(i) > weight(best)) best = i;
    }
    std::swap(row[k], row[best]);
    const DoubleDouble diagonal = m[row[k] * n + k];
    const double pivot = std::abs(diagonal.high);
    if (!(pivot > lost * scale[row[k]]) &&
        !(pivot > lost * size_in_pivot(n, k, row, [m](std::size_t at) { return m[at].high; })))
      return false;  // also when it is not a number
    for (std::size_t i = k + 1; i < n; ++i) {
      const DoubleDouble factor = m[row[i] * n + k] / diagonal;
      m[row[i] * n + k] = factor;
      for (std::size_t j = k + 1; j < n; ++j)
        m[row[i] * n + j] = m[row[i] * n + j] - factor * m[row[k] * n + j];
    }
  }
  return true;
}

void substitute_linear(std::size_t n, std::span<const DoubleDouble> m, const RowOrder& row,
                       std::span<DoubleDouble> b) noexcept {
  // L y = b, then U x = y
  std::array<DoubleDouble, largest_system> x{};
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = b[row[i]];
    for (std::size_t j = 0; j < i; ++j) x[i] = x[i] - m[row[i] * n + j] * x[j];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = i + 1; j < n; ++j) x[i] = x[i] - m[row[i] * n + j] * x[j];
    x[i] = x[i] / m[row[i] * n + i];
  }
  std::copy_n(x.begin(), n, b.begin());
}

}  // namespace qdot
