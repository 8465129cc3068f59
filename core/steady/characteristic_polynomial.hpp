#pragma once
// P(s) = det(s^2 M + s D + K) and its Hurwitz determinants, for expressions and for intervals alike.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace qdot {

/// Coefficients by ascending powers of s.
template <class T>
using PowerCoefficients = std::vector<T>;
template <class T>
using PolynomialRows = std::vector<std::vector<PowerCoefficients<T>>>;

template <class T>
PowerCoefficients<T> product_of_powers(const PowerCoefficients<T>& a, const PowerCoefficients<T>& b,
                                       const T& zero) {
  PowerCoefficients<T> result(a.size() + b.size() - 1, zero);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) result[i + j] = result[i + j] + a[i] * b[j];
  }
  return result;
}

/// By expansion along the first row: n! products, for the few rows that scenes at rest have.
template <class T>
PowerCoefficients<T> expanded_determinant(const PolynomialRows<T>& rows, const T& zero) {
  if (rows.size() == 1) return rows[0][0];
  PowerCoefficients<T> sum;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    PolynomialRows<T> minor(rows.begin() + 1, rows.end());
    for (auto& row : minor) row.erase(row.begin() + static_cast<std::ptrdiff_t>(k));
    const PowerCoefficients<T> part = product_of_powers(rows[0][k], expanded_determinant(minor, zero), zero);
    sum.resize(std::max(sum.size(), part.size()), zero);
    for (std::size_t i = 0; i < part.size(); ++i) sum[i] = k % 2 == 0 ? sum[i] + part[i] : sum[i] - part[i];
  }
  return sum;
}

/// (c_(n - 2 i + j)), i, j = 1 ... n - 1, whose determinant is H_(n-1).
template <class T>
std::vector<std::vector<T>> hurwitz_matrix(const PowerCoefficients<T>& c, const T& zero) {
  const std::size_t n = c.size() - 1;
  std::vector<std::vector<T>> rows(n - 1);
  for (std::size_t i = 1; i < n; ++i) {
    for (std::size_t j = 1; j < n; ++j) {
      const std::size_t k = 2 * i - j;  // wraps around where it is negative
      rows[i - 1].push_back(k <= n ? c[n - k] : zero);
    }
  }
  return rows;
}

}  // namespace qdot
