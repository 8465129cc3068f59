#include "core/steady/mode_matrices.hpp"

#include <algorithm>

namespace qdot {
namespace {

std::vector<double> by_rows(const SquareMatrix<Ball>& a) {
  std::vector<double> values;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < a.size(); ++j)
      values.push_back(a(i, j).contains_zero() ? 0.0 : a(i, j).value());
  }
  return values;
}

/// (A + sign A^T)/2 by rows, or nothing where that is zero.
std::vector<double> part(const SquareMatrix<Ball>& a, int sign) {
  SquareMatrix<Ball> result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < a.size(); ++j)
      result(i, j) = Ball(0.5) * (sign > 0 ? a(i, j) + a(j, i) : a(i, j) - a(j, i));
  }
  std::vector<double> values = by_rows(result);
  if (std::all_of(values.begin(), values.end(), [](double v) { return v == 0; })) values.clear();
  return values;
}

}  // namespace

SquareMatrix<Ball> square_matrix(const std::vector<Ball>& entries, std::size_t n, std::size_t width,
                                 std::size_t first) {
  SquareMatrix<Ball> result(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) result(i, j) = entries[first + i * width + j];
  }
  return result;
}

void write_matrices(const SmallMotions& motions, Modes& modes) {
  modes.mass = by_rows(motions.mass);
  modes.stiffness = by_rows(motions.stiffness);
  modes.gyroscopic = part(motions.rates, -1);
  modes.damping = part(motions.rates, 1);
}

}  // namespace qdot
