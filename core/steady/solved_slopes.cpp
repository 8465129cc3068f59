#include "core/steady/solved_slopes.hpp"

#include <algorithm>
#include <cmath>

#include "core/steady/surface_statics.hpp"

namespace qdot {
namespace {

/// In (A 1): rows are exchanged and combined until the columns of D are those of the unit matrix.
std::vector<std::size_t> eliminate(BallMatrix& a, std::size_t n) {
  std::vector<std::size_t> dependent;
  const std::size_t m = a.size();
  for (std::size_t k = 0; k < m; ++k) {
    std::size_t row = k, column = 0;
    for (std::size_t i = k; i < m; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        if (std::abs(a[i][j].value()) > std::abs(a[row][column].value())) row = i, column = j;
      }
    }
    if (a[row][column].contains_zero())
      undetermined_on_surface("at the equilibrium they depend on each other.");
    std::swap(a[k], a[row]);
    dependent.push_back(column);
    const Ball pivot = a[k][column];
    for (Ball& entry : a[k]) entry = entry / pivot;
    a[k][column] = Ball(1);
    for (std::size_t i = 0; i < m; ++i) {
      if (i == k) continue;
      const Ball factor = a[i][column];
      for (std::size_t j = 0; j < n + m; ++j) a[i][j] = a[i][j] - factor * a[k][j];
      a[i][column] = Ball(0);
    }
  }
  return dependent;
}

}  // namespace

SolvedSlopes solved_slopes(BallMatrix a, std::size_t n) {
  const std::size_t m = a.size();
  for (std::size_t k = 0; k < m; ++k) {
    for (std::size_t j = 0; j < m; ++j) a[k].emplace_back(j == k ? 1 : 0);
  }
  SolvedSlopes result;
  result.dependent = eliminate(a, n);
  result.allowed.assign(n, std::vector<Ball>(n - m, Ball(0)));
  for (std::size_t j = 0; j < n; ++j) {
    if (std::ranges::find(result.dependent, j) != result.dependent.end()) continue;
    const std::size_t f = result.free.size();
    result.free.push_back(j);
    result.allowed[j][f] = Ball(1);
    for (std::size_t k = 0; k < m; ++k) result.allowed[result.dependent[k]][f] = -a[k][j];
  }
  for (const auto& row : a)
    result.inverse.emplace_back(row.begin() + static_cast<std::ptrdiff_t>(n), row.end());
  return result;
}

}  // namespace qdot
