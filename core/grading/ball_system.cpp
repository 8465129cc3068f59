#include "core/grading/ball_system.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace qdot {
namespace {

/// The row, from k on, with the largest entry in column k.
std::size_t pivot_row(const std::vector<std::vector<Ball>>& m, std::size_t k) {
  std::size_t pivot = k;
  for (std::size_t i = k + 1; i < m.size(); ++i) {
    if (std::abs(m[i][k].value()) > std::abs(m[pivot][k].value())) pivot = i;
  }
  return pivot;
}

}  // namespace

std::optional<std::vector<Ball>> solved(std::vector<std::vector<Ball>> m, std::vector<Ball> b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t pivot = pivot_row(m, k);
    if (!m[pivot][k].is_finite() || m[pivot][k].contains_zero()) return std::nullopt;
    std::swap(m[k], m[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const Ball factor = m[i][k] / m[k][k];
      for (std::size_t j = k + 1; j < n; ++j) m[i][j] = m[i][j] - factor * m[k][j];
      b[i] = b[i] - factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] = b[k] - m[k][j] * b[j];
    b[k] = b[k] / m[k][k];
  }
  const bool is_finite = std::ranges::all_of(b, [](const Ball& x) { return x.is_finite(); });
  return is_finite ? std::optional(std::move(b)) : std::nullopt;
}

std::vector<std::vector<Ball>> transposed(const std::vector<std::vector<Ball>>& m) {
  std::vector<std::vector<Ball>> result(m.size());
  for (const auto& row : m) {
    for (std::size_t j = 0; j < row.size(); ++j) result[j].push_back(row[j]);
  }
  return result;
}

bool is_singular(std::vector<std::vector<Ball>> m) {
  constexpr double nothing = 1e-20;
  double largest = 0;
  for (const auto& row : m) {
    for (const Ball& entry : row) largest = std::max(largest, entry.magnitude());
  }
  for (std::size_t k = 0; k < m.size(); ++k) {
    const std::size_t pivot = pivot_row(m, k);
    if (m[pivot][k].magnitude() <= nothing * largest) return true;
    if (m[pivot][k].contains_zero()) return false;
    std::swap(m[k], m[pivot]);
    for (std::size_t i = k + 1; i < m.size(); ++i) {
      const Ball factor = m[i][k] / m[k][k];
      for (std::size_t j = k + 1; j < m.size(); ++j) m[i][j] = m[i][j] - factor * m[k][j];
    }
  }
  return false;
}

}  // namespace qdot
