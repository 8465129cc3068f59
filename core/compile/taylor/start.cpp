// Coefficients 0 of the rows, and what the kernels multiply by instead of dividing.

#include <algorithm>
#include <cmath>

#include "core/compile/taylor/translation.hpp"

namespace qdot {

using taylor::Kind;
using taylor::Step;

bool TaylorTranslation::invert(System& system, const Workspace& slots) {
  std::vector<double>& m = system.matrix;
  for (std::size_t i = 0; i < m.size(); ++i) m[i] = slots[system.matrix_slots[i]];
  if (system.has_determinant) {
    const double determinant = slots[system.determinant_slot];
    const double signs[4]{m[3], -m[1], -m[2], m[0]};
    for (std::size_t i = 0; i < 4; ++i) system.inverse[i] = signs[i] / determinant;
    return true;
  }
  RowOrder order;
  if (!factor_linear(system.n, m, order)) return false;
  for (std::size_t j = 0; j < system.n; ++j) {
    std::fill(system.column.begin(), system.column.end(), 0.0);
    system.column[j] = 1;
    substitute_linear(system.n, m, order, system.column);
    for (std::size_t i = 0; i < system.n; ++i) system.inverse[i * system.n + j] = system.column[i];
  }
  return true;
}

/// What a function tends to where its argument, or what it is divided by, grows beyond all numbers: there the
/// rows of that are no numbers, and its own is a constant. How far from it, the remainder tells.
bool TaylorTranslation::has_reached_limit(const Step& step) {
  constexpr double huge = 1e150;  // its coefficients of higher order may be no numbers
  const double value = std::abs(step.out[0]);
  switch (step.kind) {
    case Kind::quotient:
      return std::abs(step.y[0]) > huge && value < 1 / huge;
    case Kind::power:
      return step.x[0] > huge && value < 1 / huge;
    case Kind::exponential:
      return value == 0;
    case Kind::tangent:
      return step.constant < 0 && std::abs(*step.argument) > huge;
    default:
      return false;
  }
}

void TaylorTranslation::hold_still(Step& step) {
  step.usual = step.kind;
  step.kind = Kind::still;
  for (unsigned k = 1; k <= taylor::highest_order; ++k) {
    step.out[k] = 0;
    step.out[taylor::reversed - static_cast<int>(k)] = 0;
  }
}

/// 1 + tan^2 u or 1 - tanh^2 u; that cancels where it is small, and 1/cosh^2 u does not.
double TaylorTranslation::slope_of_tangent(const Step& step) {
  constexpr double cancels = 0.5;
  const double z = step.out[0];
  if (step.constant > 0 || z * z < cancels) return 1 + step.constant * z * z;
  const double inverse = 1 / evaluate(Function::cosh, *step.argument);
  return inverse * inverse;
}

/// What has_reached_limit() and start_own_rows() look at.
bool TaylorTranslation::has_own_start(const Step& step) {
  switch (step.kind) {
    case Kind::quotient:
    case Kind::power:
    case Kind::root:
    case Kind::exponential:
    case Kind::tangent:
    case Kind::hyperbolic:
    case Kind::absolute:
    case Kind::sign:
      return true;
    case Kind::sum_0_1:
      return !is_row_of_slot(step.out);
    default:
      return false;
  }
}

/// Rows that are no slots, and reciprocals of what a step divides by.
void TaylorTranslation::start_own_rows(Step& step) {
  if (step.kind == Kind::still) step.kind = step.usual;
  if (has_reached_limit(step)) hold_still(step);
  switch (step.kind) {
    case Kind::sum_0_1:  // 1 + u^2 or 1 - u^2, where it is a row of our own
      if (!is_row_of_slot(step.out)) {
        step.out[0] = 1 + step.products[0].factor * step.products[0].x[0] * step.products[0].y[0];
      }
      break;
    case Kind::quotient:
      step.aux[0] = 1 / step.y[0];
      break;
    case Kind::root:
      if (!is_row_of_slot(step.out)) step.out[0] = std::sqrt(step.x[0]);
      step.aux[0] = 1 / (2 * step.out[0]);
      break;
    case Kind::absolute:
    case Kind::sign:
      step.constant = evaluate(Function::sign, step.x[0]);
      break;
    case Kind::tangent:
      step.aux[0] = slope_of_tangent(step);
      break;
    default:
      break;
  }
}

bool TaylorTranslation::start(const Workspace& slots) {
  for (System& system : systems_) {
    if (!invert(system, slots)) return false;
  }
  const double* values = slots.data();
  for (const auto& [slot, row] : started_) *row = values[slot];
  double* t = row(tape_.parameters_);
  t[1] = t[taylor::reversed - 1] = 1;
  for (taylor::Product* const p : products_) {
    p->x_0 = p->factor * p->x[0];
    p->y_0 = p->factor * p->y[0];
  }
  for (const auto& [entries, solve] : entries_) {
    for (std::size_t i = 0; i < entries.size(); ++i)
      entries[i].x_0 = entries[i].factor * solve->unknowns[i % solve->n][0];
  }
  auto partner = partners_.begin();
  for (const std::size_t i : begun_) {
    Step& step = steps_[i];
    start_own_rows(step);
    if (step.kind != Kind::hyperbolic) continue;
    step.out2[0] = evaluate(partner->first, slots[partner->second]);
    ++partner;
  }
  return true;
}

}  // namespace qdot
