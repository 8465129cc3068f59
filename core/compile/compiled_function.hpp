#pragma once
// A compiled function: a flat tape of instructions on numbered slots,
// evaluated in a workspace of the caller's.
//
// The tape is immutable and shared by threads; every thread brings its own Workspace. Slots hold the
// parameters, the time, the variables, then literals and what follows; what depends on parameters alone is
// computed once, by bind. Instructions are fused sums of products
//     out = sum_i c_i x_i + sum_j c_j x_j y_j
// beside quotients, calls, sin and cos of one argument together, and solves of linear systems; a Taylor
// method can run the same tape with a row of coefficients a slot.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/numerics/evaluation.hpp"
#include "core/numerics/function.hpp"
#include "core/numerics/pairs.hpp"
#include "core/numerics/real.hpp"

namespace qdot {

namespace taylor {
class Rounding;
}

using Slot = std::uint32_t;

enum class Operation : std::uint8_t {
  sum_of_products,  ///< operands: `linear` pairs (c, x), then `products` triples (c, x, y)
  quotient,         ///< operands: x, y; x/y
  power,            ///< operands: x, c; x^c with c a literal
  square_root,      ///< operand: x
  sine_cosine,      ///< operand: x; sin x to out, cos x to out + 1
  call,             ///< operand: x
  solve             ///< operands: see LinearSystem
};

struct Instruction {
  Operation operation{};
  Function function{};       ///< of a call
  std::uint16_t linear{};    ///< pairs of a sum of products; unknowns of a solve
  std::uint16_t products{};  ///< triples of a sum of products; right-hand sides of a solve
  bool has_determinant{};    ///< of a solve: its first operand is the slot of det M
  std::uint32_t first{};     ///< first operand
  Slot out{};                ///< first slot written
};

/// Values of all slots of one tape for one thread.
using Workspace = std::vector<double>;
/// Of two sets of parameters side by side.
using PairWorkspace = std::vector<PairOfDoubles>;

class CompiledFunction {
 public:
  [[nodiscard]] std::size_t outputs() const { return outputs_.size(); }
  [[nodiscard]] std::size_t variables() const { return variables_; }
  [[nodiscard]] std::span<const Instruction> instructions() const { return body_; }
  [[nodiscard]] std::span<const Slot> operands() const { return operands_; }
  /// The same up to one of its calls, whose argument is the output.
  [[nodiscard]] CompiledFunction argument_of(const Instruction& call) const;
  /// Of accelerations a(t, q, v), whose variables are q and v: those of the same motion by a clock whose unit
  /// is u, a power of two, u^2 a(u t, q, v/u). The products with u are exact.
  [[nodiscard]] CompiledFunction in_unit_of_time(double u) const;

  /// A workspace with the parameters set and everything that depends on them alone computed.
  [[nodiscard]] Workspace bind(std::span<const double> parameters) const;

  /// Writes the outputs at time t and the variables' values (as many as variables()). On anything but ok the
  /// outputs are unspecified.
  [[nodiscard]] Evaluation evaluate(double t, std::span<const double> variables, Workspace& workspace,
                                    std::span<double> out) const noexcept;
  /// Both side by side, with the bits that each has alone; ok where both are.
  [[nodiscard]] Evaluation evaluate(double t, std::span<const PairOfDoubles> variables,
                                    PairWorkspace& workspace, std::span<PairOfDoubles> out) const noexcept;

 private:
  friend class TapeBuilder;
  template <class T>
  friend class TapeEvaluator;
  friend class TaylorTranslation;
  friend class taylor::Rounding;
  friend class ExtendedTape;

  template <class Number>
  [[nodiscard]] Evaluation values(double t, std::span<const Number> variables, std::vector<Number>& workspace,
                                  std::span<Number> out) const noexcept;
  template <class Number>
  [[nodiscard]] bool run(std::span<const Instruction> instructions, Number* slots) const noexcept;

  std::size_t parameters_{};  ///< slots 0 .. parameters_ - 1; the time and the variables follow
  std::size_t variables_{};
  std::size_t slots_{};
  std::vector<std::pair<Slot, Real>> literals_;
  std::vector<Instruction> prologue_, body_;
  std::vector<Slot> operands_;
  std::vector<Slot> outputs_;
};

}  // namespace qdot
