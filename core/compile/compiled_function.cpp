#include "core/compile/compiled_function.hpp"

#include <sleef.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/numerics/linear_system.hpp"
#include "core/numerics/side_by_side.hpp"

namespace qdot {
namespace {

#ifdef __aarch64__
constexpr auto powers_of_pairs = Sleef_cinz_powd2_u10advsimdnofma;
constexpr auto sines_and_cosines_of_pairs = Sleef_cinz_sincosd2_u10advsimdnofma;
#else
constexpr auto powers_of_pairs = Sleef_cinz_powd2_u10sse2;
constexpr auto sines_and_cosines_of_pairs = Sleef_cinz_sincosd2_u10sse2;
#endif

template <class Number>
Number sum_of_products(const Instruction& i, const Slot* operand, const Number* slots) {
  Number sum{};
  for (unsigned k = 0; k < i.linear; ++k, operand += 2) sum += slots[operand[0]] * slots[operand[1]];
  for (unsigned k = 0; k < i.products; ++k, operand += 3) {
    sum += slots[operand[0]] * slots[operand[1]] * slots[operand[2]];
  }
  return sum;
}

double power_of(double x, double exponent) { return Sleef_cinz_powd1_u10purec(x, exponent); }
PairOfDoubles power_of(PairOfDoubles x, PairOfDoubles exponent) { return powers_of_pairs(x, exponent); }

void sine_and_cosine(double* out, double x) {
  const auto both = Sleef_cinz_sincosd1_u10purec(x);
  out[0] = both.x;
  out[1] = both.y;
}
void sine_and_cosine(PairOfDoubles* out, PairOfDoubles x) {
  const auto both = sines_and_cosines_of_pairs(x);
  out[0] = both.x;
  out[1] = both.y;
}

/// Two unknowns by the determinant that was simplified symbolically; `m` by rows, one right-hand side after
/// the other. The determinant is lost when it is round-off beside the products it is made of.
template <class Number>
bool solve_two(const Number& determinant, const Number* m, std::span<Number> b) {
  for (unsigned i = 0; i < count_of<Number>; ++i) {
    const double scale =
        std::abs(one_of(m[0], i) * one_of(m[3], i)) + std::abs(one_of(m[1], i) * one_of(m[2], i));
    if (!(std::abs(one_of(determinant, i)) > 4 * std::numeric_limits<double>::epsilon() * scale))
      return false;
  }
  for (std::size_t k = 0; k < b.size(); k += 2) {
    const Number x = (m[3] * b[k] - m[1] * b[k + 1]) / determinant;
    const Number y = (m[0] * b[k + 1] - m[2] * b[k]) / determinant;
    b[k] = x;
    b[k + 1] = y;
  }
  return true;
}

bool solve_any(std::size_t n, std::span<double> m, std::span<double> b) { return solve_linear(n, m, b); }

/// One after the other.
bool solve_any(std::size_t n, std::span<const PairOfDoubles> m, std::span<PairOfDoubles> b) {
  std::array<double, largest_system * largest_system> own_m, own_b;
  for (unsigned i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < m.size(); ++k) own_m[k] = m[k][i];
    for (std::size_t k = 0; k < b.size(); ++k) own_b[k] = b[k][i];
    if (!solve_linear(n, std::span(own_m).first(m.size()), std::span(own_b).first(b.size()))) return false;
    for (std::size_t k = 0; k < b.size(); ++k) b[k][i] = own_b[k];
  }
  return true;
}

template <class Number>
bool solve(const Instruction& i, const Slot* operand, Number* slots) {
  const std::size_t n = i.linear;
  if (n == 1) {
    const Number m = slots[operand[0]];
    for (std::size_t k = 0; k < i.products; ++k) slots[i.out + k] = slots[operand[1 + k]] / m;
    return one_of(m, 0) != 0 && one_of(m, count_of<Number> - 1) != 0;
  }
  const Number determinant = i.has_determinant ? slots[*operand++] : Number{};
  std::array<Number, largest_system * largest_system> m;
  for (std::size_t k = 0; k < n * n; ++k) m[k] = slots[*operand++];
  const std::span<Number> b(slots + i.out, n * i.products);
  for (Number& value : b) value = slots[*operand++];
  if (i.has_determinant) return solve_two(determinant, m.data(), b);
  return solve_any(n, std::span(m).first(n * n), b);
}

}  // namespace

CompiledFunction CompiledFunction::argument_of(const Instruction& call) const {
  CompiledFunction result = *this;
  result.body_.resize(static_cast<std::size_t>(&call - body_.data()));
  result.outputs_ = {operands_[call.first]};
  return result;
}

CompiledFunction CompiledFunction::in_unit_of_time(double u) const {
  CompiledFunction result = *this;
  const auto literal = [&](double value) {
    result.literals_.emplace_back(static_cast<Slot>(result.slots_), value);
    return static_cast<Slot>(result.slots_++);
  };
  const auto multiple = [&](std::vector<Instruction>& to, Slot factor, Slot x) {
    const auto first = static_cast<std::uint32_t>(result.operands_.size());
    result.operands_.insert(result.operands_.end(), {factor, x});
    const auto out = static_cast<Slot>(result.slots_++);
    to.push_back({.operation = Operation::sum_of_products, .linear = 1, .first = first, .out = out});
    return out;
  };
  const Slot unit = literal(u), reciprocal = literal(1 / u), square = literal(u * u);
  const auto time = static_cast<Slot>(parameters_);
  std::vector<Instruction> body;
  const auto replace = [&](Slot slot, Slot factor) {
    const auto is_it = [slot](Slot operand) { return operand == slot; };
    if (std::ranges::none_of(operands_, is_it) && std::ranges::none_of(outputs_, is_it)) return;
    const Slot own = multiple(body, factor, slot);
    std::replace(result.operands_.begin(), result.operands_.begin() + std::ssize(operands_), slot, own);
    std::ranges::replace(result.outputs_, slot, own);
  };
  replace(time, unit);
  for (std::size_t i = variables_ / 2; i < variables_; ++i)
    replace(static_cast<Slot>(time + 1 + i), reciprocal);
  body.insert(body.end(), body_.begin(), body_.end());
  for (Slot& output : result.outputs_) output = multiple(body, square, output);
  result.body_ = std::move(body);
  return result;
}

Workspace CompiledFunction::bind(std::span<const double> parameters) const {
  Workspace workspace(slots_);
  std::copy(parameters.begin(), parameters.end(), workspace.begin());
  for (const auto& [slot, value] : literals_) workspace[slot] = value.value;
  (void)run(prologue_, workspace.data());  // what is not finite shows in the outputs
  return workspace;
}

Evaluation CompiledFunction::evaluate(double t, std::span<const double> variables, Workspace& workspace,
                                      std::span<double> out) const noexcept {
  return values(t, variables, workspace, out);
}

Evaluation CompiledFunction::evaluate(double t, std::span<const PairOfDoubles> variables,
                                      PairWorkspace& workspace, std::span<PairOfDoubles> out) const noexcept {
  return values(t, variables, workspace, out);
}

template <class Number>
Evaluation CompiledFunction::values(double t, std::span<const Number> variables,
                                    std::vector<Number>& workspace, std::span<Number> out) const noexcept {
  Number* slots = workspace.data();
  slots[parameters_] = Number{} + t;
  std::copy(variables.begin(), variables.end(), slots + parameters_ + 1);
  if (!run(body_, slots)) return Evaluation::singular_mass;
  bool finite = true;
  for (std::size_t k = 0; k < outputs_.size(); ++k) {
    out[k] = slots[outputs_[k]];
    for (unsigned i = 0; i < count_of<Number>; ++i) finite = finite && std::isfinite(one_of(out[k], i));
  }
  return finite ? Evaluation::ok : Evaluation::nonfinite;
}

template <class Number>
bool CompiledFunction::run(std::span<const Instruction> instructions, Number* slots) const noexcept {
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
        slots[i.out] = power_of(slots[operand[0]], slots[operand[1]]);
        break;
      case Operation::square_root:
        slots[i.out] = square_root(slots[operand[0]]);
        break;
      case Operation::sine_cosine:
        sine_and_cosine(slots + i.out, slots[operand[0]]);
        break;
      case Operation::call:
        slots[i.out] = of_each<Number>(
            [&](unsigned k) { return qdot::evaluate(i.function, one_of(slots[operand[0]], k)); });
        break;
      case Operation::solve:
        if (!solve(i, operand, slots)) return false;
        break;
    }
  }
  return true;
}

}  // namespace qdot
