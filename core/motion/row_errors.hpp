#pragma once
// The error of a motion's rows, from its differences to other computations of the same motion.
//
//   error = max over rows so far of ( max_j (|y - y_j| + max(|y - y_j|, 2 e_j)) + eps |y| + unseen )
//
// with e_j what another may be off by itself, as the motion has made it grow (core/integrate/separation.hpp),
// and `unseen` what the others may have missed. This holds while errors are
// small against the motion, for then they grow alike in all computations. Where a quarter of a column is in
// doubt the motion is lost: two computations that are both wrong may agree by chance, and an angle that winds
// may go any way. From there on the error is no less than four times the range of values that the
// computations have gone through up to there, and of a coordinate that nothing brings back, such as that
// angle,
//
//   error(t) >= error(t_lost) + 2 (v_max - v_min) (t - t_lost)
//
// with the range of its velocities: two motions in that range are not farther apart, where it is known.

#include <functional>
#include <span>
#include <vector>

#include "core/numerics/pairs.hpp"

namespace qdot {

/// Times the difference of two computations is the error; differences were 0.85 to 1.2 times the error.
inline constexpr double safety_of_differences = 2;

/// The same row of another computation, and how far that may be from the motion; may be empty.
struct OtherRow {
  std::span<const double> row{}, apart{};
};

/// In two columns of a row, side by side: there is an even number of them.
struct LargestOff {
  PairOfDoubles difference{}, apart{};  ///< of the others from it, and from what they stand for

  [[nodiscard]] PairOfDoubles error(PairOfDoubles value, PairOfDoubles unseen) const {
    constexpr double storing = 0x1p-52;      // a number is rounded when it is stored
    constexpr double safety_of_samples = 2;  // of what another is off by: one sample of its signs
    return difference + larger_or(safety_of_samples * apart, difference) + storing * magnitudes(value) +
           unseen;
  }
};

/// Whether a column of that size is lost.
[[nodiscard]] inline auto is_too_much(PairOfDoubles difference, PairOfDoubles size) {
  constexpr double too_much = 0.5;
  return safety_of_differences * difference > too_much * size;
}

/// The error of component k of a row alone; `unseen` may be empty.
[[nodiscard]] double error_of_row(std::size_t k, std::span<const double> row,
                                  std::span<const OtherRow> others, std::span<const double> unseen);

class RowErrors {
 public:
  /// Which coordinates nothing brings back; asked where a motion is lost.
  using Winding = std::function<std::vector<bool>()>;
  /// The largest magnitude of each column of the motion, by which errors count as large: coordinates, then
  /// velocities.
  RowErrors(std::vector<double> scale, Winding winding);

  /// The next row, at t: of the motion, and of the other computations at the same instant; `unseen` may be
  /// empty.
  void add(double t, std::span<const double> row, std::span<const OtherRow> others,
           std::span<const double> unseen = {});

  /// From the next row on it is lost, whatever that shows.
  void lose() { lost_from_next_ = true; }

  /// Of each column, up to the last row.
  [[nodiscard]] const std::vector<double>& so_far() const { return error_; }

 private:
  void widen(std::span<const double> row);
  void widen_lost(double t);
  [[nodiscard]] double range(std::size_t column) const { return highest_[column] - lowest_[column]; }

  std::vector<double> scale_, error_;
  Winding winding_;
  bool is_first_{true}, lost_{false}, lost_from_next_{false};
  double t_before_{};                 ///< the last row before the motion was lost
  std::vector<double> error_before_;  ///< at it
  std::vector<bool> winds_;           ///< once the motion is lost
  std::vector<double> lowest_, highest_;
};

}  // namespace qdot
