#pragma once
// The error of a motion's state at each of its events, from other computations' states at the same instants.
// That of the next row may be far larger, where few rows lie in a motion that amplifies its errors.
//
//   e_i = max over rows and events up to it of the error of a row (row_errors.hpp),
//   e_q = hypot(e_q, theta tau e_v),   e_v = hypot(e_q theta / tau, e_v)
//
// As differences that pass zero at an event, each coordinate's and its velocity's at another phase, are small
// by chance in one of the two, a part theta of what they turn into in the motion's own time tau = L_q/L_v
// counts as well.

#include <optional>
#include <span>
#include <vector>

#include "core/motion/motion_check.hpp"
#include "core/motion/rows_at_impacts.hpp"

namespace qdot {

/// Where the true motion is at some instant, as another computation tells.
struct StateAsTold {
  std::vector<double> beside;  ///< that one's state less the motion's
  std::vector<double> errors;  ///< what that may be off by itself
};

class ErrorsAtEvents {
 public:
  /// `scale`: of each column. Keeps references.
  ErrorsAtEvents(const ComputedMotion& motion, const std::vector<Simulation>& others,
                 std::span<const double> scale, RowsAtImpacts& at_impacts);

  /// Of the events in order, each with the errors of the last row before it. None where the others do not
  /// have its instant.
  [[nodiscard]] std::optional<std::vector<double>> next(const EventRecord& event,
                                                        std::span<const double> of_rows);

  /// By each of the others that has the instant and knows its own error.
  [[nodiscard]] std::vector<StateAsTold> as_told(const EventRecord& event) const;

 private:
  [[nodiscard]] bool take(std::size_t place, const EventRecord& event);

  const ComputedMotion& motion_;
  const std::vector<Simulation>& others_;
  std::span<const double> scale_;
  RowsAtImpacts& at_impacts_;
  std::optional<std::size_t> last_;  ///< place of the last event
  std::vector<double> so_far_;
};

}  // namespace qdot
