#pragma once
// What other computations of a motion say of the error of its rows.
//
// The differences are read by all_row_errors.hpp. What is conserved must not change by more than these errors
// allow (kept_quantities.hpp).

#include <optional>
#include <string>
#include <vector>

#include "core/motion/event_comparison.hpp"
#include "core/numerics/constants.hpp"

namespace qdot {

struct RowComparison {
  std::vector<double> max_abs_error;  ///< of each coordinate and velocity, over the rows asked for
  /// The first instant asked for where the error passes 1e-3 of a column's largest magnitude.
  std::optional<double> horizon;
  /// Of each event (event_errors.hpp); of one after the last row there is none.
  std::vector<std::optional<EventError>> event_errors;
  std::optional<EventError> stop_error;
  /// Rows asked for that are at an impact to within its error, each on the motion's side of it.
  std::vector<double> at_impacts;
  std::vector<ApproachAsTold> approaches, near_events;
  std::string changed;  ///< a conserved quantity that changes by more than the errors explain; empty: none
};

/// Only the first of the others has to have all rows; where it has not, they count as not computed.
/// `doubt`: a part of each column's magnitude that is added, for round-off that was not measured.
/// `lost_from`: rows from there on may be anywhere.
[[nodiscard]] RowComparison compare(const ComputedMotion& motion, const std::vector<Simulation>& others,
                                    double doubt, double lost_from = infinity);

enum class Rows { all, wanted };

/// The largest magnitude of each column.
[[nodiscard]] std::vector<double> largest_magnitudes(const ComputedMotion& motion, Rows which);
/// Of each column, that of all coordinates of its unit, or of all their velocities.
[[nodiscard]] std::vector<double> largest_of_kind(const ComputedMotion& motion);

}  // namespace qdot
