// M x = f: with e = x - x_row and the residual rho of the rows, M e = rho for every M of the step.

#include <algorithm>
#include <cmath>

#include "core/compile/taylor/remainder.hpp"
#include "core/numerics/linear_system.hpp"

namespace qdot::taylor {
namespace {

/// Of the products of a determinant: its bounds are good to some digits then.
constexpr double kept_of_products = 0.05;

/// Numbers near c_0 + c_1 u + c_2 u^2 + c_3 u^3, 0 <= u <= 1: no farther from it than `rest`.
struct Cubic {
  double c0{}, c1{}, c2{}, c3{}, rest{};

  [[nodiscard]] double size() const { return std::abs(c0) + std::abs(c1) + std::abs(c2) + std::abs(c3); }
};

Cubic operator*(const Cubic& a, const Cubic& b) {
  const double beyond = std::abs(a.c1 * b.c3 + a.c2 * b.c2 + a.c3 * b.c1) +
                        std::abs(a.c2 * b.c3 + a.c3 * b.c2) + std::abs(a.c3 * b.c3);
  return {a.c0 * b.c0, a.c0 * b.c1 + a.c1 * b.c0, a.c0 * b.c2 + a.c1 * b.c1 + a.c2 * b.c0,
          a.c0 * b.c3 + a.c1 * b.c2 + a.c2 * b.c1 + a.c3 * b.c0,
          beyond + a.rest * (b.size() + b.rest) + a.size() * b.rest};
}
Cubic operator+(const Cubic& a, const Cubic& b) {
  return {a.c0 + b.c0, a.c1 + b.c1, a.c2 + b.c2, a.c3 + b.c3, a.rest + b.rest};
}
Cubic operator-(const Cubic& a, const Cubic& b) {
  return {a.c0 - b.c0, a.c1 - b.c1, a.c2 - b.c2, a.c3 - b.c3, a.rest + b.rest};
}

/// c_3 u^3 is anywhere between 0 and c_3.
Range range_of(const Cubic& a) {
  if (!std::isfinite(a.size() + a.rest)) return {};
  const double end = a.c0 + a.c1 + a.c2, place = -a.c1 / (2 * a.c2);
  const double extremum = place > 0 && place < 1 ? a.c0 + 0.5 * a.c1 * place : a.c0;
  return range(std::min({a.c0, end, extremum}) + std::min(0.0, a.c3) - a.rest,
               std::max({a.c0, end, extremum}) + std::max(0.0, a.c3) + a.rest);
}

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
  std::array<double, largest_system> error{};
  bound_solution_of(rule, rho, error);
  for (std::size_t i = 0; i < n; ++i) conclude(rows_[rule.unknowns[i]], error[i]);
}

void Remainder::bound_solution_of(Index first_unknown, std::span<const double> rho,
                                  std::span<double> error) const {
  const auto is_it = [&](const Rule& rule) {
    return rule.solve != nullptr && rule.unknowns.front() == first_unknown;
  };
  const auto rule = std::ranges::find_if(rules_, is_it);
  if (rule == rules_.end())
    std::ranges::fill(error, infinity);
  else
    bound_solution_of(*rule, rho, error);
}

void Remainder::bound_solution_of(const Rule& rule, std::span<const double> rho,
                                  std::span<double> error) const {
  const std::size_t n = rule.right.size();
  if (n == 2 && bound_pair(rule, rho, error)) return;
  if (n == 3 && bound_triple(rule, rho, error)) return;
  bound_unknowns(rule, rho, error);
}

/// By Cramer's rule, where the determinant stays away from zero.
bool Remainder::bound_pair(const Rule& rule, std::span<const double> rho, std::span<double> error) const {
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
  error[0] = bound(m[3], m[1]);
  error[1] = bound(m[2], m[0]);
  return true;
}

/// The same for three, whose entries are followed to u^3, u = s/h: what they have in common cancels in the
/// determinant, as cos^2 + sin^2 does.
bool Remainder::bound_triple(const Rule& rule, std::span<const double> rho, std::span<double> error) const {
  std::array<Cubic, 9> m, minor;
  for (std::size_t at = 0; at < m.size(); ++at) {
    m[at].c0 = *rule.solve->start[at];
    const auto& [factor, pointer, unused] = rule.solve->matrix[at];
    if (pointer == nullptr) continue;
    const Row& row = rows_[rule.matrix[at]];
    const double* c = row.coefficients;
    m[at].c1 = factor * c[1] * h_;
    m[at].c2 = factor * c[2] * powers_[2];
    m[at].c3 = factor * c[3] * powers_[3];
    m[at].rest = std::abs(factor) * beyond_third(row);
  }
  for (std::size_t i = 0; i < 3; ++i) {  // with their signs, by cyclic places
    const std::size_t i1 = 3 * ((i + 1) % 3), i2 = 3 * ((i + 2) % 3);
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      minor[3 * i + j] = m[i1 + j1] * m[i2 + j2] - m[i1 + j2] * m[i2 + j1];
    }
  }
  const Cubic one = m[0] * minor[0], two = m[1] * minor[1], three = m[2] * minor[2];
  const double determinant = range_of(one + two + three).least_magnitude();
  const double size = one.size() + two.size() + three.size();
  if (!(determinant > kept_of_products * size)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    double bound = 0;
    for (std::size_t j = 0; j < 3; ++j) bound += range_of(minor[3 * j + i]).magnitude() * rho[j];
    error[i] = bound / determinant;
  }
  return true;
}

/// An entry a u + b u^2 + ..., u = s/h, is a/2 + 3b/8 + (a + b) w/2 + (b/8)(2 w^2 - 1) + ... with |w| <= 1:
/// over a long step M moves far, but all of its entries together.
void Remainder::bound_unknowns(const Rule& rule, std::span<const double> rho, std::span<double> error) const {
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
  bound_solution(n, {middle, radius, std::span(moving).first(2 * n * n)}, rho, error);
}

}  // namespace qdot::taylor
