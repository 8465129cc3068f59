#pragma once
// What the errors of coordinates and velocities do to a quantity C(t, y) that is computed from them.
//
// Where every component k of a row is within e_k of the motion, C is evaluated in balls [y_k - e_k, y_k +
// e_k], with the parameters as they were typed. That encloses the true value, so that its error is no more
// than the distance of the column's number from the far end of the ball.

#include <span>
#include <vector>

#include "core/motion/simulation_request.hpp"

namespace qdot {

/// Rows of a motion, and of each component the error over all of them.
struct RowsWithErrors {
  std::span<const double> t{};
  std::span<const double> states{};  ///< rows x 2n, row-major
  std::span<const double> errors{};  ///< 2n
};

/// The largest error of a column over the rows; infinite where the ball has no bound. `values`: the column.
[[nodiscard]] double column_error(const Dynamics& dynamics, const Column& column, const Reals& parameters,
                                  const RowsWithErrors& rows, std::span<const double> values);

}  // namespace qdot
