#include "core/numerics/linear_system.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/numerics/constants.hpp"
#include "core/numerics/lost_pivot.hpp"

namespace qdot {
namespace {

// `Size` is a number, or one that the compiler knows: most systems with a mass matrix to factor have three
// unknowns.

using Scale = std::array<double, largest_system>;

template <class Size>
void take_row_scales(Size n, std::span<const double> m, Scale& scale) {
  for (std::size_t i = 0; i < n; ++i) {
    scale[i] = 0;
    for (std::size_t j = 0; j < n; ++j) scale[i] = std::max(scale[i], std::abs(m[i * n + j]));
  }
}

/// Brings the row with the largest scaled entry of column k to place k.
template <class Size>
void pivot(Size n, std::size_t k, std::span<const double> m, const Scale& scale, RowOrder& row) {
  std::size_t best = k;
  const auto weight = [&](std::size_t i) { return std::abs(m[row[i] * n + k]) / scale[row[i]]; };
  for (std::size_t i = k + 1; i < n; ++i) {
    if (weight(i) > weight(best)) best = i;
  }
  std::swap(row[k], row[best]);
}

/// Of rounding, which is `lost` of what it is the sum of; of its row's scale first, which takes no time.
template <class Size>
bool is_pivot_lost(Size n, std::size_t k, std::span<const double> m, const Scale& scale, const RowOrder& row,
                   double lost) {
  const double pivot = std::abs(m[row[k] * n + k]);
  if (pivot > lost * scale[row[k]]) return false;
  return !(pivot > lost * size_in_pivot(n, k, row, [m](std::size_t at) { return m[at]; }));  // nor a number
}

template <class Size>
bool factor_rows(Size n, std::span<double> m, RowOrder& row) {
  Scale scale;
  take_row_scales(n, m, scale);
  const double lost = 4 * static_cast<double>(n) * std::numeric_limits<double>::epsilon();
  for (std::size_t i = 0; i < n; ++i) row[i] = i;
  for (std::size_t k = 0; k < n; ++k) {
    pivot(n, k, m, scale, row);
    if (is_pivot_lost(n, k, m, scale, row, lost)) return false;
    const double diagonal = m[row[k] * n + k];
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = m[row[i] * n + k] / diagonal;
      m[row[i] * n + k] = factor;
      for (std::size_t j = k + 1; j < n; ++j) m[row[i] * n + j] -= factor * m[row[k] * n + j];
    }
  }
  return true;
}

template <class Size>
void substitute_rows(Size n, std::span<const double> m, const RowOrder& row, std::span<double> b) {
  // L y = b, then U x = y
  std::array<double, largest_system> x;
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = b[row[i]];
    for (std::size_t j = 0; j < i; ++j) x[i] -= m[row[i] * n + j] * x[j];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = i + 1; j < n; ++j) x[i] -= m[row[i] * n + j] * x[j];
    x[i] /= m[row[i] * n + i];
  }
  for (std::size_t i = 0; i < n; ++i) b[i] = x[i];
}

using Three = std::integral_constant<std::size_t, 3>;

using SmallMatrix = std::array<double, largest_system * largest_system>;  // n x n of it are used

/// |1 - Y M| at most, Y by columns: Y_ij = y[j n + i].
void bound_rest(std::size_t n, const SmallMatrix& y, const MatrixFamily& matrices, SmallMatrix& rest) {
  const std::size_t count = matrices.moving.size() / (n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      double off = i == j ? -1 : 0, spread = 0;
      for (std::size_t k = 0; k < n; ++k) {
        off += y[k * n + i] * matrices.middle[k * n + j];
        spread += std::abs(y[k * n + i]) * matrices.radius[k * n + j];
      }
      for (std::size_t m = 0; m < count; ++m) {
        double sum = 0;
        for (std::size_t k = 0; k < n; ++k) sum += y[k * n + i] * matrices.moving[(m * n + k) * n + j];
        spread += std::abs(sum);
      }
      rest[i * n + j] = std::abs(off) + spread;
    }
  }
}

}  // namespace

bool factor_linear(std::size_t n, std::span<double> m, RowOrder& row) noexcept {
  return n == 3 ? factor_rows(Three{}, m, row) : factor_rows(n, m, row);
}

void substitute_linear(std::size_t n, std::span<const double> m, const RowOrder& row,
                       std::span<double> b) noexcept {
  n == 3 ? substitute_rows(Three{}, m, row, b) : substitute_rows(n, m, row, b);
}

bool solve_linear(std::size_t n, std::span<double> m, std::span<double> b) noexcept {
  RowOrder row;
  if (!factor_linear(n, m, row)) return false;
  for (std::size_t k = 0; k < b.size() / n; ++k) substitute_linear(n, m, row, b.subspan(k * n, n));
  return true;
}

void bound_solution(std::size_t n, const MatrixFamily& matrices, std::span<const double> rho,
                    std::span<double> bound) noexcept {
  constexpr int most_rounds = 20;
  constexpr double inflation = 1.1;
  constexpr double least = 1e-300;  // above 0, so that a bound that holds also shows M to have an inverse
  SmallMatrix m, y, rest;
  std::copy_n(matrices.middle.begin(), n * n, m.begin());
  std::fill_n(y.begin(), n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) y[i * n + i] = 1;
  std::fill_n(bound.begin(), n, infinity);
  if (!solve_linear(n, std::span(m).first(n * n), std::span(y).first(n * n))) return;
  bound_rest(n, y, matrices, rest);
  std::array<double, largest_system> base{}, x{};
  for (std::size_t i = 0; i < n; ++i) {
    base[i] = least;
    for (std::size_t j = 0; j < n; ++j) base[i] += std::abs(y[j * n + i]) * rho[j];
  }
  for (int round = 0; round < most_rounds; ++round) {
    bool holds = true;
    std::array<double, largest_system> next;  // n of them are used
    for (std::size_t i = 0; i < n; ++i) {
      next[i] = base[i];
      for (std::size_t j = 0; j < n; ++j) next[i] += rest[i * n + j] * x[j];
      holds = holds && next[i] <= x[i];
    }
    if (holds) {
      std::copy_n(x.begin(), n, bound.begin());
      return;
    }
    for (std::size_t i = 0; i < n; ++i) x[i] = inflation * next[i];
  }
}

}  // namespace qdot
