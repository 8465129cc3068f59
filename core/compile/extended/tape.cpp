#include "core/compile/extended/tape.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/numerics/double_double_function.hpp"
#include "core/numerics/double_double_system.hpp"

namespace qdot {
namespace {

/// Beyond the largest numbers error-free transformations give no number; which infinity it is, doubles tell.
template <class InDoubles>
DoubleDouble or_infinite(const DoubleDouble& value, const InDoubles& in_doubles) {
  if (is_finite(value)) return value;
  const double rough = in_doubles();
  return std::isinf(rough) ? DoubleDouble(rough) : value;
}

DoubleDouble quotient(const DoubleDouble& x, const DoubleDouble& y) {
  return std::isinf(y.high) ? DoubleDouble(x.high / y.high) : x / y;
}

}  // namespace

ExtendedTape::ExtendedTape(const CompiledFunction& function, std::span<const DoubleDouble> parameters)
    : function_(function), slots_(function.slots_) {
  std::ranges::copy(parameters, slots_.begin());
  for (const auto& [slot, value] : function.literals_) slots_[slot] = value.double_double();
  (void)run(function.prologue_);  // what is not finite shows in the outputs
}

Evaluation ExtendedTape::evaluate(const DoubleDouble& t, std::span<const DoubleDouble> variables) {
  slots_[time_slot()] = t;
  std::ranges::copy(variables, slots_.begin() + time_slot() + 1);
  if (!run(function_.body_)) return Evaluation::singular_mass;
  const bool all_finite =
      std::ranges::all_of(function_.outputs_, [&](Slot slot) { return is_finite(slots_[slot]); });
  return all_finite ? Evaluation::ok : Evaluation::nonfinite;
}

Evaluation ExtendedTape::evaluate(const DoubleDouble& t, std::span<const DoubleDouble> variables,
                                  std::span<DoubleDouble> out) {
  const Evaluation evaluation = evaluate(t, variables);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = slots_[function_.outputs_[i]];
  return evaluation;
}

bool ExtendedTape::run(std::span<const Instruction> instructions) {
  for (const Instruction& i : instructions) {
    const Slot* operand = function_.operands_.data() + i.first;
    const DoubleDouble x = slots_[operand[0]];
    switch (i.operation) {
      case Operation::sum_of_products:
        slots_[i.out] = or_infinite(sum_of_products(i, operand), [&] { return rough_sum(i, operand); });
        break;
      case Operation::quotient:
        slots_[i.out] = quotient(x, slots_[operand[1]]);
        break;
      case Operation::power:
        slots_[i.out] = power(x, slots_[operand[1]]);
        break;
      case Operation::square_root:
        slots_[i.out] = sqrt(x);
        break;
      case Operation::sine_cosine: {
        const auto [sine, cosine] = sine_cosine(x);
        slots_[i.out] = sine;
        slots_[i.out + 1] = cosine;
        break;
      }
      case Operation::call:
        slots_[i.out] =
            or_infinite(qdot::evaluate(i.function, x), [&] { return qdot::evaluate(i.function, x.high); });
        break;
      case Operation::solve:
        if (!solve(i, operand)) return false;
        break;
    }
  }
  return true;
}

DoubleDouble ExtendedTape::sum_of_products(const Instruction& i, const Slot* operand) const {
  DoubleDouble sum;
  for (unsigned k = 0; k < i.linear; ++k, operand += 2) sum = sum + slots_[operand[0]] * slots_[operand[1]];
  for (unsigned k = 0; k < i.products; ++k, operand += 3) {
    sum = sum + slots_[operand[0]] * (slots_[operand[1]] * slots_[operand[2]]);
  }
  return sum;
}

double ExtendedTape::rough_sum(const Instruction& i, const Slot* operand) const {
  double sum = 0;
  for (unsigned k = 0; k < i.linear; ++k, operand += 2) {
    sum += slots_[operand[0]].high * slots_[operand[1]].high;
  }
  for (unsigned k = 0; k < i.products; ++k, operand += 3) {
    sum += slots_[operand[0]].high * (slots_[operand[1]].high * slots_[operand[2]].high);
  }
  return sum;
}

bool ExtendedTape::solve(const Instruction& i, const Slot* operand) {
  const std::size_t n = i.linear;
  if (n == 1) {
    const DoubleDouble m = slots_[operand[0]];
    for (std::size_t k = 0; k < i.products; ++k) slots_[i.out + k] = slots_[operand[1 + k]] / m;
    return m.high != 0;
  }
  const DoubleDouble determinant = i.has_determinant ? slots_[*operand++] : 0.0;
  std::array<DoubleDouble, largest_system * largest_system> m;
  for (std::size_t k = 0; k < n * n; ++k) m[k] = slots_[*operand++];
  const std::span<DoubleDouble> b(slots_.data() + i.out, n * i.products);
  for (DoubleDouble& value : b) value = slots_[*operand++];
  if (i.has_determinant) {
    const double scale = std::abs((m[0] * m[3]).high) + std::abs((m[1] * m[2]).high);
    if (!(std::abs(determinant.high) > 0x1p-102 * scale)) return false;
    for (std::size_t k = 0; k < b.size(); k += 2) {
      const DoubleDouble x = (m[3] * b[k] - m[1] * b[k + 1]) / determinant;
      const DoubleDouble y = (m[0] * b[k + 1] - m[2] * b[k]) / determinant;
      b[k] = x;
      b[k + 1] = y;
    }
    return true;
  }
  RowOrder row{};
  if (!factor_linear(n, std::span(m).first(n * n), row)) return false;
  for (std::size_t k = 0; k < i.products; ++k) substitute_linear(n, m, row, b.subspan(k * n, n));
  return true;
}

}  // namespace qdot
