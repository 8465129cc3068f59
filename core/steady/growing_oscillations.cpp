#include "core/steady/growing_oscillations.hpp"

#include <algorithm>

#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

/// By ascending powers of s.
using PowerCoefficients = std::vector<Expression>;

PowerCoefficients times(const PowerCoefficients& a, const PowerCoefficients& b) {
  PowerCoefficients result(a.size() + b.size() - 1, a[0].graph().number(0));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) result[i + j] = result[i + j] + a[i] * b[j];
  }
  return result;
}

/// det(s^2 M + s D + K) by expansion along the first row.
PowerCoefficients determinant_of(const std::vector<std::vector<PowerCoefficients>>& rows) {
  if (rows.size() == 1) return rows[0][0];
  PowerCoefficients sum(2 * rows.size() + 1, rows[0][0][0].graph().number(0));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    std::vector<std::vector<PowerCoefficients>> minor;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      minor.push_back(rows[i]);
      minor.back().erase(minor.back().begin() + static_cast<std::ptrdiff_t>(k));
    }
    const PowerCoefficients part = times(rows[0][k], determinant_of(minor));
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = k % 2 == 0 ? sum[i] + part[i] : sum[i] - part[i];
  }
  return sum;
}

/// Without the roots s = 0 that it has in any case.
PowerCoefficients characteristic(const Matrix& mass, const Matrix& rates, const Matrix& stiffness) {
  std::vector<std::vector<PowerCoefficients>> rows;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    rows.emplace_back();
    for (std::size_t j = 0; j < mass.size(); ++j)
      rows.back().push_back({stiffness[i][j], rates[i][j], mass[i][j]});
  }
  PowerCoefficients all = determinant_of(rows);
  for (Expression& c : all) c = simplify(c);
  while (!all.empty() && all.back().is_zero()) all.pop_back();
  const auto first = std::ranges::find_if_not(all, &Expression::is_zero);
  return {first, all.end()};
}

/// H_(N-1).
Expression hurwitz_determinant(const PowerCoefficients& c) {
  const std::size_t n = c.size() - 1;
  Matrix h(n - 1);
  for (std::size_t i = 1; i < n; ++i) {
    for (std::size_t j = 1; j < n; ++j) {
      const std::size_t k = 2 * i - j;  // wraps around where it is negative
      h[i - 1].push_back(k <= n ? c[n - k] : c[0].graph().number(0));
    }
  }
  return determinant(h);
}

/// Of b_0 + b_1 z + ..., of degree 2 or 3.
Expression discriminant(const PowerCoefficients& b) {
  if (b.size() == 3) return b[1] * b[1] - Number(4) * b[0] * b[2];
  return b[2] * b[2] * b[1] * b[1] - Number(4) * b[3] * b[1] * b[1] * b[1] -
         Number(4) * b[2] * b[2] * b[2] * b[0] + Number(18) * b[3] * b[2] * b[1] * b[0] -
         Number(27) * b[3] * b[3] * b[0] * b[0];
}

bool is_even(const PowerCoefficients& c) {
  for (std::size_t k = 1; k < c.size(); k += 2) {
    if (!c[k].is_zero()) return false;
  }
  return true;
}

std::optional<GrowingOscillations> of_even(const PowerCoefficients& c) {
  PowerCoefficients b;
  for (std::size_t k = 0; k < c.size(); k += 2) b.push_back(c[k]);
  if (b.size() != 3 && b.size() != 4) return std::nullopt;
  GrowingOscillations result{discriminant(b), std::nullopt, true};
  if (b.size() == 3) result.square = b[1] / (Number(2) * b[2]);
  return result;
}

bool always_has_energy(const Matrix& rates, const Matrix& stiffness) {
  for (std::size_t i = 0; i < rates.size(); ++i) {
    for (std::size_t j = 0; j < rates.size(); ++j) {
      if (!rates[i][j].is_zero() || !simplify(stiffness[i][j] - stiffness[j][i]).is_zero()) return false;
    }
  }
  return true;
}

}  // namespace

std::optional<GrowingOscillations> growing_oscillations(const Matrix& mass, const Matrix& rates,
                                                        const Matrix& stiffness) {
  if (mass.size() > largest_written_system || always_has_energy(rates, stiffness)) return std::nullopt;
  const PowerCoefficients c = characteristic(mass, rates, stiffness);
  if (c.size() < 3) return std::nullopt;
  if (is_even(c)) return of_even(c);
  GrowingOscillations result{hurwitz_determinant(c), std::nullopt, false};
  switch (c.size()) {
    case 3:
      result.square = c[0] / c[2];
      break;
    case 4:
      result.square = c[1] / c[3];
      break;
    case 5:
      result.square = c[1] / c[3];
      break;
    default:
      break;
  }
  return result;
}

}  // namespace qdot
