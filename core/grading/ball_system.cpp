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

std::optional<std::vector<std::vector<Ball>>> inverted(const std::vector<std::vector<Ball>>& m) {
  std::vector<std::vector<Ball>> columns;
  for (std::size_t j = 0; j < m.size(); ++j) {
    std::vector<Ball> unit(m.size(), Ball(0.0));
    unit[j] = Ball(1.0);
    auto column = solved(m, std::move(unit));
    if (!column) return std::nullopt;
    columns.push_back(std::move(*column));
  }
  return transposed(columns);
}

std::optional<std::vector<Ball>> krawczyk_image(const std::vector<std::vector<Ball>>& inverse,
                                                const std::vector<Ball>& residuals,
                                                const std::vector<std::vector<Ball>>& slopes_in_box,
                                                double radius) {
  std::vector<Ball> image(residuals.size(), Ball(0.0));
  for (std::size_t i = 0; i < image.size(); ++i) {
    for (std::size_t j = 0; j < image.size(); ++j) {
      Ball rest(i == j ? 1.0 : 0.0);
      for (std::size_t k = 0; k < image.size(); ++k) rest = rest - inverse[i][k] * slopes_in_box[k][j];
      image[i] = image[i] - inverse[i][j] * residuals[j] + rest * Ball(DoubleDouble(0.0), radius);
    }
    if (!image[i].is_finite() || !(image[i].magnitude() < radius)) return std::nullopt;
  }
  return image;
}

bool has_full_rank(std::vector<std::vector<Ball>> m, std::size_t columns) {
  if (m.size() < columns) return false;
  for (std::size_t k = 0; k < columns; ++k) {
    const std::size_t pivot = pivot_row(m, k);
    if (!m[pivot][k].is_finite() || m[pivot][k].contains_zero()) return false;
    std::swap(m[k], m[pivot]);
    for (std::size_t i = k + 1; i < m.size(); ++i) {
      const Ball factor = m[i][k] / m[k][k];
      for (std::size_t j = k + 1; j < columns; ++j) m[i][j] = m[i][j] - factor * m[k][j];
    }
  }
  return true;
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
