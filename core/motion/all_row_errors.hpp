#pragma once
// The error of each row of a motion, from other computations of it: what row_errors.hpp reads off their
// differences, and what these may not show.
//
// A row is where its instant t has been rounded to, and was asked for at a decimal: by so much, half a unit
// in the last place of t, the motion goes on in between, and |y'| times that is added. A difference may be
// passing zero at a row, by chance, but then its slope is not zero: that of coordinates is the difference of
// velocities. So much it may be half-way to the next row, or a tenth of the motion's own time L_q / L_v away.

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/motion/row_errors.hpp"

namespace qdot {

/// Of a motion, one after the other; states has 2n columns.
struct RowsToCompare {
  std::span<const double> t{}, left_out{};  ///< instants, and what each leaves out of the one that was typed
  std::span<const double> states{};
  std::span<const double> sizes{};  ///< L of each column
};

/// Of another computation, at the same instants; the last ones may be missing. All but the states may be
/// empty.
struct OtherRows {
  std::size_t rows{};
  std::span<const double> states{}, apart{}, unseen{};
  std::span<const double> accelerations{};  ///< bounds near each row; not a number where there is none
};

class AllRowErrors {
 public:
  /// Accelerations at a row of the motion. False where there are none.
  using AccelerationsAt = std::function<bool(std::size_t row, std::span<double> accelerations)>;

  AllRowErrors(const RowsToCompare& motion, std::vector<OtherRows> others, AccelerationsAt accelerations,
               RowErrors::Winding winding);

  /// Of the first rows, so many of them, row-major. Rows from `lost_from` on may be anywhere.
  [[nodiscard]] std::vector<double> first(std::size_t rows, double lost_from);

 private:
  void take_others();
  void add_roundings_of_instants();
  [[nodiscard]] double rounding_of_instant(std::size_t row) const;
  [[nodiscard]] const double* accelerations_at(std::size_t row);
  void add_slopes_of_differences();
  [[nodiscard]] bool is_lost(double lost_from) const;
  [[nodiscard]] std::vector<double> while_known() const;
  [[nodiscard]] std::vector<double> with_lost(double lost_from) const;

  RowsToCompare motion_;
  std::vector<OtherRows> others_;
  AccelerationsAt accelerations_at_;
  RowErrors::Winding winding_;
  std::size_t width_, rows_{};
  std::vector<double> difference_, apart_, missed_;  ///< the largest for each number of each row
  std::vector<double> accelerations_;                ///< at a row
};

}  // namespace qdot
