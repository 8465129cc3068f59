#include "core/compile/taylor/start.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/numerics/linear_system.hpp"
#include "core/numerics/side_by_side.hpp"

namespace qdot {
namespace {

using taylor::BasicStep;
using taylor::Kind;

bool invert(std::size_t n, std::span<double> m, std::span<double> inverse) {
  RowOrder order;
  std::array<double, largest_system> column_of{};
  const auto column = std::span(column_of).first(n);
  if (!factor_linear(n, m, order)) return false;
  for (std::size_t j = 0; j < n; ++j) {
    std::ranges::fill(column, 0.0);
    column[j] = 1;
    substitute_linear(n, m, order, column);
    for (std::size_t i = 0; i < n; ++i) inverse[i * n + j] = column[i];
  }
  return true;
}

bool invert(std::size_t n, std::span<const PairOfDoubles> m, std::span<PairOfDoubles> inverse) {
  std::array<double, largest_system * largest_system> own_m, own_inverse;
  for (unsigned lane = 0; lane < 2; ++lane) {
    for (std::size_t i = 0; i < n * n; ++i) own_m[i] = m[i][lane];
    if (!invert(n, std::span(own_m).first(n * n), std::span(own_inverse).first(n * n))) return false;
    for (std::size_t i = 0; i < n * n; ++i) inverse[i][lane] = own_inverse[i];
  }
  return true;
}

/// By cofactors: for a third of what elimination takes, which has found before that there is an inverse.
/// False where they leave the range of doubles, or nearly; and where the determinant is small beside its
/// terms: of an ill-conditioned matrix cofactors lose twice the digits that elimination does.
template <class Number>
bool invert_three(const Number* m, Number* inverse) {
  const auto cofactor = [m](unsigned i, unsigned j) {
    const unsigned i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    return m[3 * i1 + j1] * m[3 * i2 + j2] - m[3 * i1 + j2] * m[3 * i2 + j1];
  };
  const Number row[]{cofactor(0, 0), cofactor(0, 1), cofactor(0, 2)};
  const Number determinant = m[0] * row[0] + m[1] * row[1] + m[2] * row[2];
  const auto size_of_terms = [m](unsigned j, unsigned lane) {
    const auto size = [m, lane](unsigned i) { return std::abs(one_of(m[i], lane)); };
    const unsigned j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    return size(j) * (size(3 + j1) * size(6 + j2) + size(3 + j2) * size(6 + j1));
  };
  for (unsigned lane = 0; lane < count_of<Number>; ++lane) {
    constexpr double most_lost = 32;
    const double size = std::abs(one_of(determinant, lane));
    const double terms = size_of_terms(0, lane) + size_of_terms(1, lane) + size_of_terms(2, lane);
    if (!(size > 1e-100 && size < 1e100 && most_lost * size > terms)) return false;
  }
  const Number factor = 1.0 / determinant;
  Number differences{};
  for (unsigned i = 0; i < 3; ++i) {
    inverse[3 * i] = factor * row[i];
    for (unsigned j = 1; j < 3; ++j) inverse[3 * i + j] = factor * cofactor(j, i);
    for (unsigned j = 0; j < 3; ++j) differences += inverse[3 * i + j] - inverse[3 * i + j];
  }
  return one_of(differences, 0) == 0 && one_of(differences, count_of<Number> - 1) == 0;
}

template <class Number>
bool invert(typename TaylorStart<Number>::System& system, std::span<const Number> slots) {
  std::vector<Number>& m = system.matrix;
  for (std::size_t i = 0; i < m.size(); ++i) m[i] = slots[system.matrix_slots[i]];
  if (system.n == 3 && invert_three(m.data(), system.inverse.data())) return true;
  if (!system.has_determinant) return invert(system.n, std::span(m), std::span(system.inverse));
  const Number determinant = slots[system.determinant_slot];
  const Number signs[4]{m[3], -m[1], -m[2], m[0]};
  for (std::size_t i = 0; i < 4; ++i) system.inverse[i] = signs[i] / determinant;
  return true;
}

/// What a function tends to where its argument, or what it is divided by, grows beyond all numbers: there the
/// rows of that are no numbers, and its own is a constant. How far from it, the remainder tells.
template <class Number>
bool has_reached_limit(const BasicStep<Number>& step, unsigned lane) {
  constexpr double huge = 1e150;  // its coefficients of higher order may be no numbers
  const double value = std::abs(one_of(step.out[0], lane));
  switch (step.kind) {
    case Kind::quotient:
      return std::abs(one_of(step.y[0], lane)) > huge && value < 1 / huge;
    case Kind::power:
      return one_of(step.x[0], lane) > huge && value < 1 / huge;
    case Kind::exponential:
      return value == 0;
    case Kind::tangent:
      return one_of(step.constant, lane) < 0 && std::abs(one_of(*step.argument, lane)) > huge;
    default:
      return false;
  }
}

void hold_still(BasicStep<double>& step) {
  step.usual = step.kind;
  step.kind = Kind::still;
  for (unsigned k = 1; k <= taylor::highest_order; ++k) {
    step.out[k] = 0;
    step.out[taylor::reversed - static_cast<int>(k)] = 0;
  }
}

/// False where the others of the step would have to go on.
bool heed_limit(BasicStep<double>& step) {
  if (step.kind == Kind::still) step.kind = step.usual;
  if (has_reached_limit(step, 0)) hold_still(step);
  return true;
}
bool heed_limit(BasicStep<PairOfDoubles>& step) {
  return !has_reached_limit(step, 0) && !has_reached_limit(step, 1);
}

/// 1 + tan^2 u or 1 - tanh^2 u; that cancels where it is small, and 1/cosh^2 u does not.
double slope_of_tangent(double constant, double z, double argument) {
  constexpr double cancels = 0.5;
  if (constant > 0 || z * z < cancels) return 1 + constant * z * z;
  const double inverse = 1 / evaluate(Function::cosh, argument);
  return inverse * inverse;
}

template <class Number>
void begin_sum(BasicStep<Number>& step) {
  Number total = Number{} + step.constant;
  for (unsigned i = 0; i < step.term_count; ++i) total += step.terms[i].factor * step.terms[i].x[0];
  for (unsigned i = 0; i < step.product_count; ++i) {
    const taylor::BasicProduct<Number>& p = step.products[i];
    total += p.factor * (p.x[0] * p.y[0]);
  }
  step.out[0] = total;
}

template <class Number>
void begin_solution(const taylor::BasicSolve<Number>& system) {
  for (std::size_t i = 0; i < system.n; ++i) {
    Number value{};
    for (std::size_t j = 0; j < system.n; ++j) value += system.inverse[i * system.n + j] * system.right[j][0];
    system.unknowns[i][0] = value;
  }
}

/// Rows that are no slots, and reciprocals of what a step divides by.
template <class Number>
void begin_step(BasicStep<Number>& step, const typename TaylorStart<Number>::Own& own,
                std::span<const Number> slots) {
  switch (step.kind) {
    case Kind::sum_0_1:  // 1 + u^2 or 1 - u^2, where it is a row of our own
      if (!own.is_row_of_slot) {
        step.out[0] = 1.0 + step.products[0].factor * step.products[0].x[0] * step.products[0].y[0];
      }
      break;
    case Kind::quotient:
      step.aux[0] = 1.0 / step.y[0];
      break;
    case Kind::root:
      if (!own.is_row_of_slot) step.out[0] = square_root(step.x[0]);
      step.aux[0] = 1.0 / (2.0 * step.out[0]);
      break;
    case Kind::absolute:
    case Kind::sign:
      step.constant =
          of_each<Number>([&](unsigned i) { return evaluate(Function::sign, one_of(step.x[0], i)); });
      break;
    case Kind::tangent:
      step.aux[0] = of_each<Number>([&](unsigned i) {
        return slope_of_tangent(one_of(step.constant, i), one_of(step.out[0], i), one_of(*step.argument, i));
      });
      break;
    case Kind::hyperbolic:
      step.out2[0] = of_each<Number>(
          [&](unsigned i) { return evaluate(own.partner, one_of(slots[own.argument_slot], i)); });
      break;
    default:
      break;
  }
}

}  // namespace

template <class Number>
bool TaylorStart<Number>::begin(std::span<const Number> slots, BasicStep<Number>* steps) {
  for (System& system : systems) {
    if (!invert<Number>(system, slots)) return false;
  }
  for (const auto& [slot, row] : rows) *row = slots[slot];
  time[1] = time[taylor::reversed - 1] = Number{} + 1.0;
  for (const std::size_t i : put_together) {
    if (steps[i].solve == nullptr)
      begin_sum(steps[i]);
    else
      begin_solution(*steps[i].solve);
  }
  for (taylor::BasicProduct<Number>* const p : products) {
    p->x_0 = p->factor * p->x[0];
    p->y_0 = p->factor * p->y[0];
  }
  for (const auto& [all, solve] : entries) {
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i].x_0 = all[i].factor * solve->unknowns[i % solve->n][0];
  }
  for (const Own& one : own) {
    if (!heed_limit(steps[one.step])) return false;
    begin_step<Number>(steps[one.step], one, slots);
  }
  return true;
}

template struct TaylorStart<double>;
template struct TaylorStart<PairOfDoubles>;

}  // namespace qdot
