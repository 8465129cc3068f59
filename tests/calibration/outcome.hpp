#pragma once
// What became of a request: the stated error of each column beside the true one.

#include "tests/calibration/requests.hpp"

namespace qdot::test {

struct ColumnOutcome {
  std::string name;
  double stated{};      ///< max_abs_error
  double true_error{};  ///< over the returned rows that the reference vouches for
  double scale{};       ///< the column's largest magnitude in its rows
  double size_along{};  ///< and along the motion, as far as its horizon asks for it
};

struct Outcome {
  MeasuredSimulation measured;
  std::string refusal;                     ///< of a request that has no motion at all
  std::size_t known_rows{};                ///< that the reference vouches for
  std::vector<ColumnOutcome> columns;      ///< none where there are no rows to compare
  std::optional<double> true_horizon;      ///< where the true error passes 1e-3 of a column
  std::optional<double> earliest_horizon;  ///< where three times the true error does
  double cpu{}, reference_cpu{};           ///< s

  [[nodiscard]] bool failed() const;  ///< a problem, not an answer
  [[nodiscard]] std::string status() const;
};

/// Asks the program, and where it answers the reference, which takes at most so many steps.
[[nodiscard]] Outcome outcome_of(const Asked& asked, std::uint64_t reference_steps);

}  // namespace qdot::test
