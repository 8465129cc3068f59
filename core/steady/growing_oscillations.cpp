#include "core/steady/growing_oscillations.hpp"

#include <algorithm>

#include "core/expr/simplify.hpp"
#include "core/steady/characteristic_polynomial.hpp"

namespace qdot {
namespace {

using Powers = PowerCoefficients<Expression>;

/// The characteristic polynomial, divided by the powers of s that it has in any case.
Powers characteristic(const Matrix& mass, const Matrix& rates, const Matrix& stiffness) {
  PolynomialRows<Expression> rows;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    rows.emplace_back();
    for (std::size_t j = 0; j < mass.size(); ++j)
      rows.back().push_back({stiffness[i][j], rates[i][j], mass[i][j]});
  }
  Powers all = expanded_determinant(rows, mass[0][0].graph().number(0));
  for (Expression& c : all) c = simplify(c);
  while (!all.empty() && all.back().is_zero()) all.pop_back();
  const auto first = std::ranges::find_if_not(all, &Expression::is_zero);
  return {first, all.end()};
}

/// The discriminant of b_0 + b_1 z + ..., a polynomial of degree 2 or 3.
Expression discriminant(const Powers& b) {
  if (b.size() == 3) return b[1] * b[1] - Number(4) * b[0] * b[2];
  return b[2] * b[2] * b[1] * b[1] - Number(4) * b[3] * b[1] * b[1] * b[1] -
         Number(4) * b[2] * b[2] * b[2] * b[0] + Number(18) * b[3] * b[2] * b[1] * b[0] -
         Number(27) * b[3] * b[3] * b[0] * b[0];
}

bool is_even(const Powers& c) {
  for (std::size_t k = 1; k < c.size(); k += 2) {
    if (!c[k].is_zero()) return false;
  }
  return true;
}

std::optional<GrowingOscillations> of_even(const Powers& c) {
  Powers b;
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
  const Powers c = characteristic(mass, rates, stiffness);
  if (c.size() < 3) return std::nullopt;
  if (is_even(c)) return of_even(c);
  GrowingOscillations result{determinant(hurwitz_matrix(c, c[0].graph().number(0))), std::nullopt, false};
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
