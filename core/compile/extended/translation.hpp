#pragma once
// From a tape to what the Taylor recurrences in double-doubles work on (kernels.hpp).

#include <deque>
#include <span>
#include <vector>

#include "core/compile/extended/kernels.hpp"
#include "core/compile/extended/tape.hpp"

namespace qdot {

class ExtendedTranslation {
 public:
  /// Of a tape with its parameters set.
  explicit ExtendedTranslation(const ExtendedTape& tape);

  /// Coefficients 0, from the slots of an evaluation, and 0 for all others up to `order`. False where a mass
  /// matrix has no inverse.
  [[nodiscard]] bool start(const ExtendedTape& tape, unsigned order);
  [[nodiscard]] extended::Program program() const;

 private:
  /// Coefficient 0 of a row that is no slot of the tape.
  enum class Start : std::uint8_t {
    none,  ///< a row of rates: its coefficient 0 comes with the others' coefficient 1
    one_plus_square,
    one_minus_square,
    inverse_square_of_cosh,
    square_root,
    function  ///< of x
  };
  struct OwnRow {
    double* row{};
    Start start{};
    const double* x{};
    Function function{};
  };
  struct LinearSystem {
    std::vector<Slot> matrix_slots;
    bool has_determinant{};
    Slot determinant_slot{};
    std::vector<const double*> matrix, right;
    std::vector<double*> unknowns;
    std::vector<DoubleDouble> inverse;
  };

  void translate(const Instruction& instruction);
  void add_sum(const Instruction& instruction);
  void add_call(const Instruction& instruction);
  void add_power(const Instruction& instruction);
  void add_arc(const Instruction& instruction);
  void add_tangent(const Instruction& instruction);
  void add_solve(const Instruction& instruction);
  void add_quotient(const double* x, const double* y, double* out, unsigned lag);
  void add_product(const DoubleDouble& factor, const double* x, const double* y, double* out, unsigned lag);
  /// out' = factor x y
  void add_integral_of_product(const DoubleDouble& factor, const double* x, const double* y, double* out);
  void add_integral(const DoubleDouble& factor, const double* x, double* out);
  [[nodiscard]] const double* rate_of(Slot slot);
  [[nodiscard]] double* own_row(Start start, const double* x = nullptr, Function function = {});

  [[nodiscard]] static bool invert(LinearSystem& system, std::span<const DoubleDouble> slots);
  static void start_own_row(const OwnRow& own);

  [[nodiscard]] double* row(std::size_t index) { return rows_.data() + index * extended::row_length; }
  [[nodiscard]] bool varies(Slot slot) const { return varies_[slot]; }

  const CompiledFunction& function_;
  std::span<const DoubleDouble> constants_;
  Slot time_;
  std::vector<bool> varies_;
  std::vector<double> rows_;
  std::size_t rows_used_;
  unsigned order_before_{extended::highest_order};  ///< of the last start: beyond it rows are 0
  std::deque<std::vector<extended::Term>> terms_;
  std::deque<std::vector<extended::Product>> products_;
  std::deque<LinearSystem> systems_;
  std::deque<extended::System> views_;  ///< of systems_, for the kernels
  std::vector<OwnRow> own_rows_;
  std::vector<extended::Step> steps_;
  std::vector<double*> state_;
  std::vector<const double*> accelerations_;
};

}  // namespace qdot
