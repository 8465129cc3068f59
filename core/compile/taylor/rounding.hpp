#pragma once
// What rounding may do to the accelerations over a Taylor step.
//
// A force that is the small difference of large numbers, such as cosh(x) - 1 for a small x or exp of a square
// that is written out, is rounded by far more than its last digit, and all computations of a motion have that
// in common. So every slot w of the tape has a bound e of |w as it is computed - w|, from the bounds of what
// it is computed from (running error analysis), u = 2^-53:
//
//   x y    |x| e_y + |y| e_x + e_x e_y + u |x y|
//   x + y  e_x + e_y + u (|x| + |y|)
//   f(x)   max |f'| e_x + 2 u |f|,   and so on.
//
// Where a point would hide what lies beside it, |x| is sum_k |c_k| h^k of the slot's row, which bounds the
// roundings of all its coefficients, and least magnitudes are those of the whole step (remainder.hpp). The
// state is exact, and so are the parameters: whoever moves them answers for their rounding. Literals are not:
// 0.86 is no double.
//
// Where w overflows, or a root's argument nearly vanishes, e/|w| is bounded instead: by what factors,
// quotients and sums of terms of one sign, such as squares, are off relatively. That is a bound at each place
// of the step, but not of what rounded coefficients of a series add up to between them. Source: Higham,
// Accuracy and Stability of Numerical Algorithms, 2nd ed., 3.3 (running error analysis).

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/compile/compiled_function.hpp"
#include "core/compile/taylor/remainder.hpp"

namespace qdot::taylor {

inline constexpr double half_unit_of_doubles = 0x1p-53, half_unit_of_double_doubles = 0x1p-103;

class Rounding {
 public:
  using RowOf = std::function<const double*(Slot)>;
  /// Keeps references. `slots`: the tape's, where parameters are set.
  Rounding(const CompiledFunction& tape, const Workspace& slots, const Remainder& remainder,
           const RowOf& row_of);

  /// For each acceleration a bound over the step whose defect was bounded last, beyond 64 u |q''|: some last
  /// digits of its own are rounded in every motion, and whoever steps knows them. Infinite where there is
  /// none. `unit`: u, of doubles or of double-doubles.
  void bound(double unit, std::span<double> accelerations);
  /// The same of a function's output in doubles, all of it: along the piece that was looked at last.
  [[nodiscard]] double of_output();

 private:
  static constexpr double no_bound_known = std::numeric_limits<double>::infinity();
  struct Size {
    double most{};                    ///< of |w|
    double error{};                   ///< e
    double relative{no_bound_known};  ///< of e/|w|, where w may overflow and e with it
  };

  void take_constants();
  void take_unit(double unit);
  void take_variables();
  void apply(const Instruction& instruction);
  [[nodiscard]] Size sum(const Instruction& instruction, const Slot* operand) const;
  [[nodiscard]] double relative_of_sum(const Instruction& instruction, const Slot* operand) const;
  [[nodiscard]] Size quotient(Slot x, Slot y, Slot out) const;
  [[nodiscard]] Size power(const Instruction& instruction, const Slot* operand) const;
  [[nodiscard]] Size root(Slot x, Slot out) const;
  [[nodiscard]] Size function(const Instruction& instruction, Slot x) const;
  [[nodiscard]] Size exponential(Slot x, Slot out) const;
  void apply_sine_cosine(const Instruction& instruction, Slot x);
  [[nodiscard]] double of_entry(Slot m, std::size_t unknowns) const;
  [[nodiscard]] double part_made_again(const Instruction& instruction, const Slot* m,
                                       std::span<double> first) const;
  void apply_solve(const Instruction& instruction, const Slot* operand);

  [[nodiscard]] const Remainder::Row* measured(Slot slot) const;
  [[nodiscard]] Range values(Slot slot) const;
  /// What has no row is computed where the step begins, as the determinant of a mass matrix is.
  [[nodiscard]] bool is_at_start_alone(Slot slot) const;
  [[nodiscard]] double least(Slot slot) const { return values(slot).least_magnitude(); }
  [[nodiscard]] double relative(Slot slot) const;
  /// sum_k |c_k| h^k of a result, or what it cannot exceed.
  [[nodiscard]] double most(Slot slot, double otherwise) const;

  /// A last place of a function's value.
  [[nodiscard]] double of_functions() const { return 2 * unit_; }

  const CompiledFunction& tape_;
  const Workspace& slots_;
  const Remainder& remainder_;
  static constexpr Remainder::Index no_row = ~Remainder::Index{};
  std::vector<Remainder::Index> rows_;  ///< of slots; no_row where it has none
  std::vector<bool> varies_;
  std::vector<bool> is_power_of_two_;      ///< or -2: products with it are exact
  std::vector<bool> is_asked_relatively_;  ///< by roots and powers, whose slope has no bound at 0
  std::vector<Size> sizes_;
  std::vector<Slot> waiting_;       ///< variables whose rows are not measured
  std::vector<double> in_doubles_;  ///< of constants: their errors there
  double unit_{half_unit_of_doubles};
};

}  // namespace qdot::taylor
