#pragma once
// A tape evaluated in other numbers than doubles: in intervals or balls, to enclose its values; in divided
// differences, to compare two places without cancellation.

#include <algorithm>
#include <cassert>
#include <span>
#include <tuple>
#include <vector>

#include "core/base/work.hpp"
#include "core/compile/compiled_function.hpp"
#include "core/numerics/enclosed_system.hpp"

namespace qdot {

/// For one tape, at one time, 0 at first, and one set of parameters.
/// T has T::literal(Real), +, *, /, square, sqrt, sin, cos, power(T, T) or power(T, Real) and
/// evaluate(Function, T), and solve_linear as in core/numerics/enclosed_system.hpp; without it the tape has
/// no `solve`.
template <class T>
class TapeEvaluator {
 public:
  TapeEvaluator(const CompiledFunction& function, std::span<const T> parameters)
      : function_(function), slots_(function.slots_, T::literal(0)) {
    assert(parameters.size() == function.parameters_);
    for (const auto& [slot, value] : function.literals_) {
      slots_[slot] = T::literal(value);
      if (value == Real(1)) one_ = slot;
    }
    bind(parameters);
  }

  void bind(std::span<const T> parameters) {
    for (std::size_t i = 0; i < parameters.size(); ++i) slots_[i] = parameters[i];
    run(function_.prologue_);
  }

  /// From now on that sign(u) or abs(u) is what it is on one side of u = 0.
  void take_side(Slot out, int side) { side_ = {out, side}; }

  void set_time(const T& t) { slots_[function_.parameters_] = t; }

  void operator()(std::span<const T> variables, std::span<T> out) {
    for (std::size_t i = 0; i < variables.size(); ++i) slots_[function_.parameters_ + 1 + i] = variables[i];
    run(function_.body_);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = slots_[function_.outputs_[i]];
  }

  /// Values of all slots.
  [[nodiscard]] std::span<const T> slots() const { return slots_; }

 private:
  void run(std::span<const Instruction> instructions) {
    spend_work(instructions.size());
    for (const Instruction& i : instructions) {
      const Slot* operand = function_.operands_.data() + i.first;
      const T& x = slots_[operand[0]];
      switch (i.operation) {
        case Operation::sum_of_products:
          slots_[i.out] = sum_of_products(i, operand);
          break;
        case Operation::quotient:
          slots_[i.out] = x / slots_[operand[1]];
          break;
        case Operation::power:
          slots_[i.out] = raised(x, operand[1]);
          break;
        case Operation::square_root:
          slots_[i.out] = sqrt(x);
          break;
        case Operation::sine_cosine: {
          const T argument = x;
          if constexpr (requires { sine_cosine(argument); }) {
            std::tie(slots_[i.out], slots_[i.out + 1]) = sine_cosine(argument);
          } else {
            slots_[i.out] = sin(argument);
            slots_[i.out + 1] = cos(argument);
          }
          break;
        }
        case Operation::call:
          slots_[i.out] = i.out == side_.out ? on_side(i.function, x) : evaluate(i.function, x);
          break;
        case Operation::solve:
          solve(i, operand);
          break;
      }
    }
  }

  [[nodiscard]] T on_side(Function function, const T& x) const {
    const T side = T::literal(side_.side);
    return function == Function::sign ? side : side * x;
  }

  [[nodiscard]] T sum_of_products(const Instruction& i, const Slot* operand) const {
    T sum = T::literal(0);
    bool first = true;
    const auto add = [&](const T& term) {
      sum = first ? term : sum + term;  // 0 + x would be rounded once more
      first = false;
    };
    for (unsigned k = 0; k < i.linear; ++k, operand += 2) add(scaled(operand[0], slots_[operand[1]]));
    for (unsigned k = 0; k < i.products; ++k, operand += 3) {
      const T& x = slots_[operand[1]];
      add(scaled(operand[0], operand[1] == operand[2] ? square(x) : x * slots_[operand[2]]));
    }
    return sum;
  }

  void solve(const Instruction& i, const Slot* operand) {
    if constexpr (requires(std::span<T> b) { solve_linear(0, std::span<const T>(b), b); }) {
      const std::size_t n = i.linear;
      if (i.has_determinant) ++operand;
      std::vector<T> matrix;
      for (std::size_t k = 0; k < n * n; ++k) matrix.push_back(slots_[*operand++]);
      const std::span<T> b(slots_.data() + i.out, n * i.products);
      for (T& value : b) value = slots_[*operand++];
      solve_linear(n, std::span<const T>(matrix), b);
    } else {
      for (std::size_t k = 0; k < std::size_t{i.linear} * i.products; ++k) slots_[i.out + k] = undefined();
    }
  }

  /// What is known where the arithmetic cannot compute.
  [[nodiscard]] static T undefined() {
    if constexpr (requires { T::undefined(); })
      return T::undefined();
    else
      return T::literal(1) / T::literal(0);
  }

  /// Exponents are literals; an arithmetic whose own literals do not show a whole number takes them as they
  /// are.
  [[nodiscard]] T raised(const T& x, Slot exponent) const {
    if constexpr (requires { power(x, x); }) {
      return power(x, slots_[exponent]);
    } else {
      const auto is_exponent = [=](const auto& literal) { return literal.first == exponent; };
      return power(x, std::ranges::find_if(function_.literals_, is_exponent)->second);
    }
  }

  /// Most coefficients are the literal 1.
  [[nodiscard]] T scaled(Slot coefficient, const T& x) const {
    return coefficient == one_ ? x : slots_[coefficient] * x;
  }

  const CompiledFunction& function_;
  std::vector<T> slots_;
  static constexpr auto none = static_cast<Slot>(-1);
  Slot one_{none};  ///< of the literal 1
  struct Side {
    Slot out{none};
    int side{};
  };
  Side side_;
};

}  // namespace qdot
