#include "core/grading/ball_system.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace qdot {

std::optional<std::vector<Ball>> solved(std::vector<std::vector<Ball>> m, std::vector<Ball> b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i) {
      if (std::abs(m[i][k].value()) > std::abs(m[pivot][k].value())) pivot = i;
    }
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

}  // namespace qdot
