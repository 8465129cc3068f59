#include "core/compile/compiled_function.hpp"

#include <sleef.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/numerics/linear_system.hpp"

namespace qdot {
namespace {

double sum_of_products(const Instruction& i, const Slot* operand, const double* slots) {
  double sum = 0;
  for (unsigned k = 0; k < i.linear; ++k, operand += 2) sum += slots[operand[0]] * slots[operand[1]];
  for (unsigned k = 0; k < i.products; ++k, operand += 3) {
    sum += slots[operand[0]] * slots[operand[1]] * slots[operand[2]];
  }
  return sum;
}

/// Two unknowns by the determinant that was simplified symbolically; `m` by rows, one right-hand side after
/// the other. The determinant is lost when it is round-off beside the products it is made of.
bool solve_two(double determinant, const double* m, std::span<double> b) {
  const double scale = std::abs(m[0] * m[3]) + std::abs(m[1] * m[2]);
  if (!(std::abs(determinant) > 4 * std::numeric_limits<double>::epsilon() * scale)) return false;
  for (std::size_t k = 0; k < b.size(); k += 2) {
    const double x = (m[3] * b[k] - m[1] * b[k + 1]) / determinant;
    const double y = (m[0] * b[k + 1] - m[2] * b[k]) / determinant;
    b[k] = x;
    b[k + 1] = y;
  }
  return true;
}

bool solve(const Instruction& i, const Slot* operand, double* slots) {
  const std::size_t n = i.linear;
  if (n == 1) {
    const double m = slots[operand[0]];
    for (std::size_t k = 0; k < i.products; ++k) slots[i.out + k] = slots[operand[1 + k]] / m;
    return m != 0;
  }
  const double determinant = i.has_determinant ? slots[*operand++] : 0;
  std::array<double, largest_system * largest_system> m;
  for (std::size_t k = 0; k < n * n; ++k) m[k] = slots[*operand++];
  const std::span<double> b(slots + i.out, n * i.products);
  for (double& value : b) value = slots[*operand++];
  if (i.has_determinant) return solve_two(determinant, m.data(), b);
  return solve_linear(n, std::span(m).first(n * n), b);
}

}  // namespace

Workspace CompiledFunction::bind(std::span<const double> parameters) const {
  Workspace workspace(slots_);
  std::copy(parameters.begin(), parameters.end(), workspace.begin());
  for (const auto& [slot, value] : literals_) workspace[slot] = value.value;
  (void)run(prologue_, workspace.data());  // what is not finite shows in the outputs
  return workspace;
}

Evaluation CompiledFunction::evaluate(double t, std::span<const double> variables, Workspace& workspace,
                                      std::span<double> out) const noexcept {
  double* slots = workspace.data();
  slots[parameters_] = t;
  std::copy(variables.begin(), variables.end(), slots + parameters_ + 1);
  if (!run(body_, slots)) return Evaluation::singular_mass;
  bool finite = true;
  for (std::size_t k = 0; k < outputs_.size(); ++k) {
    out[k] = slots[outputs_[k]];
    finite = finite && std::isfinite(out[k]);
  }
  return finite ? Evaluation::ok : Evaluation::nonfinite;
}

bool CompiledFunction::run(std::span<const Instruction> instructions, double* slots) const noexcept {
  const Slot* const operands = operands_.data();
  for (const Instruction& i : instructions) {
    const Slot* operand = operands + i.first;
    switch (i.operation) {
      case Operation::sum_of_products:
        slots[i.out] = sum_of_products(i, operand, slots);
        break;
      case Operation::quotient:
        slots[i.out] = slots[operand[0]] / slots[operand[1]];
        break;
      case Operation::power:
        slots[i.out] = Sleef_cinz_powd1_u10purec(slots[operand[0]], slots[operand[1]]);
        break;
      case Operation::square_root:
        slots[i.out] = std::sqrt(slots[operand[0]]);
        break;
      case Operation::sine_cosine: {
        const auto both = Sleef_cinz_sincosd1_u10purec(slots[operand[0]]);
        slots[i.out] = both.x;
        slots[i.out + 1] = both.y;
        break;
      }
      case Operation::call:
        slots[i.out] = qdot::evaluate(i.function, slots[operand[0]]);
        break;
      case Operation::solve:
        if (!solve(i, operand, slots)) return false;
        break;
    }
  }
  return true;
}

}  // namespace qdot
