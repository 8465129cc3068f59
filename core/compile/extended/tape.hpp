#pragma once
// A tape evaluated in double-doubles, with everything a tape can hold: the time, solves of linear systems.
// Parameters, time and variables come with twice the digits of doubles, as the decimals that were typed have
// them.

#include <span>
#include <vector>

#include "core/compile/compiled_function.hpp"
#include "core/numerics/double_double.hpp"

namespace qdot {

/// The workspace of one thread. Keeps a reference to the tape.
class ExtendedTape {
 public:
  ExtendedTape(const CompiledFunction& function, std::span<const DoubleDouble> parameters);

  /// Computes every slot at time t and the variables' values. On anything but ok they are unspecified.
  [[nodiscard]] Evaluation evaluate(const DoubleDouble& t, std::span<const DoubleDouble> variables);
  /// The same, and writes the outputs.
  [[nodiscard]] Evaluation evaluate(const DoubleDouble& t, std::span<const DoubleDouble> variables,
                                    std::span<DoubleDouble> out);

  [[nodiscard]] const CompiledFunction& function() const { return function_; }
  /// Values of all slots.
  [[nodiscard]] std::span<const DoubleDouble> slots() const { return slots_; }
  [[nodiscard]] Slot time_slot() const { return static_cast<Slot>(function_.parameters_); }
  [[nodiscard]] std::span<const Slot> outputs() const { return function_.outputs_; }

 private:
  [[nodiscard]] bool run(std::span<const Instruction> instructions);
  [[nodiscard]] DoubleDouble sum_of_products(const Instruction& i, const Slot* operand) const;
  /// The same in doubles.
  [[nodiscard]] double rough_sum(const Instruction& i, const Slot* operand) const;
  [[nodiscard]] bool solve(const Instruction& i, const Slot* operand);

  const CompiledFunction& function_;
  std::vector<DoubleDouble> slots_;
};

}  // namespace qdot
