#pragma once
// What the errors of coordinates and velocities do to a quantity C(t, y) that is computed from them.
//
// Where every component k of a row is within e_k of the motion, C is evaluated in balls [y_k - e_k, y_k +
// e_k], with the parameters as they were typed. That encloses the true value, so that its error is no more
// than the distance of the column's number from the far end of the ball.

#include <span>
#include <vector>

#include "core/compile/tape_evaluator.hpp"
#include "core/motion/simulation_request.hpp"
#include "core/numerics/ball.hpp"

namespace qdot {

/// Any number to which t is nearest, such as the decimal that was typed.
[[nodiscard]] Ball instant(double t);
[[nodiscard]] Ball instant(const Real& t);

/// The largest error of each column over the rows of a motion.
class ColumnErrors {
 public:
  ColumnErrors(const Dynamics& dynamics, const std::vector<Column>& columns, const Reals& parameters);

  /// A row, its instant and state known within balls, in which the columns were found to have `values`.
  void add(const Ball& t, std::span<const Ball> y, std::span<const DoubleDouble> values);

  /// Of each column; infinite where a ball has no bound, and for accelerations and multipliers of a scene
  /// with kinks, where they jump.
  [[nodiscard]] const std::vector<double>& largest() const { return largest_; }

 private:
  std::shared_ptr<const CompiledFunction> function_;
  TapeEvaluator<Ball> evaluator_;
  std::vector<Ball> found_;
  std::vector<double> largest_;
};

/// Rows of a motion, and of each component the error over all of them.
struct RowsWithErrors {
  std::span<const double> t{};
  std::span<const double> states{};  ///< rows x 2n, row-major
  std::span<const double> errors{};  ///< 2n
};

/// The largest errors over the rows. `values`: of each column the numbers.
[[nodiscard]] std::vector<double> column_errors(const Dynamics& dynamics, const std::vector<Column>& columns,
                                                const Reals& parameters, const RowsWithErrors& rows,
                                                std::span<const std::span<const double>> values);

/// The errors of a function's values that were computed in doubles, at one state; infinite where the ball has
/// no bound. `t` stands for any number that is nearest to it.
[[nodiscard]] std::vector<double> value_errors(const CompiledFunction& function, const Reals& parameters,
                                               double t, const Reals& y, std::span<const double> values);

}  // namespace qdot
