// Coefficients 0 of the rows, and what the kernels multiply by instead of dividing.

#include <algorithm>
#include <cmath>

#include "core/compile/extended/translation.hpp"
#include "core/numerics/double_double_function.hpp"
#include "core/numerics/double_double_system.hpp"

namespace qdot {
namespace {

DoubleDouble first_of(const double* row) { return {row[0], row[extended::run_length]}; }

void set_first(double* row, const DoubleDouble& value) {
  row[0] = row[2 * extended::run_length + extended::last] = value.high;
  row[extended::run_length] = row[3 * extended::run_length + extended::last] = value.low;
}

/// As in doubles (core/compile/taylor/start.cpp): rows that are no numbers need not matter.
bool has_reached_limit(const extended::Step& step) {
  constexpr double huge = 1e150;
  const double value = step.out == nullptr ? 1 : std::abs(step.out[0]);
  if (step.kind == extended::Kind::quotient && step.lag == 0) {
    return std::abs(step.y[0]) > huge && value < 1 / huge;
  }
  if (step.kind != extended::Kind::integral || step.argument == nullptr) return false;
  return value == 0 || std::abs(step.argument[0]) > huge;
}

/// In all four runs.
[[gnu::always_inline]] inline void clear(double* row, unsigned count) {
  for (std::size_t part = 0; part < 2; ++part, row += extended::run_length) {
    std::fill_n(row, count, 0.0);
    std::fill_n(row + 2 * extended::run_length + extended::last - (count - 1), count, 0.0);
  }
}

/// Coefficients up to `order`; a few more where their number is then known here: most expansions are short.
void clear_up_to(double* row, unsigned order) {
  constexpr unsigned short_count = 8;
  order < short_count ? clear(row, short_count) : clear(row, order + 1);
}

}  // namespace

bool ExtendedTranslation::start(const ExtendedTape& tape, unsigned order) {
  const std::span<const DoubleDouble> slots = tape.slots();
  for (std::size_t i = time_; i < rows_used_; ++i) clear_up_to(row(i), order_before_);
  order_before_ = order;
  for (std::size_t slot = 0; slot < slots.size(); ++slot) set_first(row(slot), slots[slot]);
  double* t = row(time_);
  t[1] = t[2 * extended::run_length + extended::last - 1] = 1;
  for (const OwnRow& own : own_rows_) start_own_row(own);
  for (LinearSystem& system : systems_) {
    if (!invert(system, slots)) return false;
  }
  for (extended::Step& step : steps_) {
    if (step.kind == extended::Kind::still) step.kind = step.usual;
    if (has_reached_limit(step)) {
      step.usual = step.kind;
      step.kind = extended::Kind::still;
    }
    if (step.kind == extended::Kind::quotient) step.inverse = DoubleDouble(1) / first_of(step.y);
    if (step.kind == extended::Kind::root) step.inverse = DoubleDouble(0.5) / first_of(step.out);
  }
  return true;
}

void ExtendedTranslation::start_own_row(const OwnRow& own) {
  const DoubleDouble one = 1.0;
  const DoubleDouble x = own.x != nullptr ? first_of(own.x) : DoubleDouble();
  switch (own.start) {
    case Start::none:
      return;
    case Start::one_plus_square:
      return set_first(own.row, one + x * x);
    case Start::one_minus_square:
      return set_first(own.row, (one - x) * (one + x));
    case Start::inverse_square_of_cosh: {
      constexpr double underflows = 400;
      if (std::abs(x.high) > underflows) return set_first(own.row, 0.0);
      const DoubleDouble inverse = one / evaluate(Function::cosh, x);
      return set_first(own.row, inverse * inverse);
    }
    case Start::square_root:
      return set_first(own.row, sqrt(x));
    case Start::function:
      return set_first(own.row, evaluate(own.function, x));
  }
}

bool ExtendedTranslation::invert(LinearSystem& system, std::span<const DoubleDouble> slots) {
  const std::size_t n = system.unknowns.size();
  std::vector<DoubleDouble> m;
  for (const Slot slot : system.matrix_slots) m.push_back(slots[slot]);
  if (system.has_determinant) {
    const DoubleDouble determinant = slots[system.determinant_slot];
    const DoubleDouble adjugate[4]{m[3], -m[1], -m[2], m[0]};
    for (std::size_t i = 0; i < 4; ++i) system.inverse[i] = adjugate[i] / determinant;
    return true;
  }
  RowOrder order{};
  if (!factor_linear(n, m, order)) return false;
  std::vector<DoubleDouble> column(n);
  for (std::size_t j = 0; j < n; ++j) {
    std::ranges::fill(column, DoubleDouble());
    column[j] = 1.0;
    substitute_linear(n, m, order, column);
    for (std::size_t i = 0; i < n; ++i) system.inverse[i * n + j] = column[i];
  }
  return true;
}

}  // namespace qdot
