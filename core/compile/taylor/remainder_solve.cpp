// M x = f: with e = x - x_row and the residual rho of the rows, M e = rho for every M of the step.

#include <algorithm>
#include <cmath>

#include "core/compile/taylor/remainder.hpp"
#include "core/numerics/linear_system.hpp"

namespace qdot::taylor {
namespace {

/// Of the products of a determinant: its bounds are good to some digits then.
constexpr double kept_of_products = 0.05;

}  // namespace

void Remainder::apply_solve(const Rule& rule) {
  const std::size_t n = rule.right.size();
  std::array<double, largest_system> rho{};
  for (std::size_t i = 0; i < n; ++i) {
    rho[i] = rows_[rule.right[i]].r + rows_[rule.right[i]].own_top;
    for (std::size_t j = 0; j < n; ++j) {
      const Entry& entry = rule.solve->matrix[i * n + j];
      if (entry.m == nullptr) continue;
      const Row &m = rows_[rule.matrix[i * n + j]], &x = rows_[rule.unknowns[j]];
      rho[i] += std::abs(entry.factor) * (tail(m, x) + m.r * x.of_row.magnitude());
    }
  }
  if (n != 2 || !bound_pair(rule, rho)) bound_unknowns(rule, rho);
}

/// By Cramer's rule, where the determinant stays away from zero.
bool Remainder::bound_pair(const Rule& rule, std::span<const double> rho) {
  std::array<Range, 4> m;
  for (std::size_t at = 0; at < m.size(); ++at) {
    const double start = *rule.solve->start[at];
    m[at] = {start, start};
    const Entry& entry = rule.solve->matrix[at];
    if (entry.m == nullptr) continue;
    const Row& row = rows_[rule.matrix[at]];
    m[at] = entry.factor * (row.of_value - row.coefficients[0]) + start;
  }
  const Range one = m[0] * m[3], other = m[1] * m[2];
  const double determinant = (one + -1.0 * other).least_magnitude();
  if (!(determinant > kept_of_products * (one.magnitude() + other.magnitude()))) return false;
  const auto bound = [&](const Range& of_first, const Range& of_second) {
    return (of_first.magnitude() * rho[0] + of_second.magnitude() * rho[1]) / determinant;
  };
  conclude(rows_[rule.unknowns[0]], bound(m[3], m[1]));
  conclude(rows_[rule.unknowns[1]], bound(m[2], m[0]));
  return true;
}

/// An entry a u + b u^2 + ..., u = s/h, is a/2 + 3b/8 + (a + b) w/2 + (b/8)(2 w^2 - 1) + ... with |w| <= 1:
/// over a long step M moves far, but all of its entries together.
void Remainder::bound_unknowns(const Rule& rule, std::span<const double> rho) {
  constexpr std::size_t size = largest_system * largest_system;
  const std::size_t n = rule.right.size();
  std::array<double, size> middle, radius;  // n x n of each are used
  std::array<double, 2 * size> moving;
  for (std::size_t at = 0; at < n * n; ++at) {
    middle[at] = *rule.solve->start[at];
    radius[at] = moving[at] = moving[n * n + at] = 0;
    const Entry& entry = rule.solve->matrix[at];
    if (entry.m == nullptr) continue;
    const Row& row = rows_[rule.matrix[at]];
    const double a = entry.factor * row.coefficients[1] * h_;
    const double b = entry.factor * row.coefficients[2] * powers_[2];
    middle[at] += 0.5 * a + 0.375 * b;
    moving[at] = 0.5 * (a + b);
    moving[n * n + at] = 0.125 * b;
    radius[at] = std::abs(entry.factor) * beyond_second(row);
  }
  std::array<double, largest_system> error{};
  bound_solution(n, {middle, radius, std::span(moving).first(2 * n * n)}, rho, error);
  for (std::size_t i = 0; i < n; ++i) conclude(rows_[rule.unknowns[i]], error[i]);
}

}  // namespace qdot::taylor
