#include "core/motion/column_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/work.hpp"
#include "core/compile/tape_evaluator.hpp"
#include "core/numerics/ball.hpp"

namespace qdot {
namespace {

/// Bound of |x - value| for every x in the ball.
double distance(const Ball& ball, double value) {
  const double bound = (ball - Ball(value)).magnitude();
  return std::isfinite(bound) ? bound : std::numeric_limits<double>::infinity();
}

}  // namespace

double column_error(const Dynamics& dynamics, const Column& column, const Reals& parameters,
                    const RowsWithErrors& rows, std::span<const double> values) {
  const auto function = dynamics.columns({column});
  const std::vector<Ball> constants = parameters.as<Ball>();
  TapeEvaluator<Ball> evaluator(*function, constants);
  const std::size_t width = rows.errors.size();
  std::vector<Ball> y(width), out(1);
  double error = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % 256 == 0) check_interruption();
    for (std::size_t k = 0; k < width; ++k)
      y[k] = Ball(DoubleDouble(rows.states[i * width + k]), rows.errors[k]);
    evaluator.set_time(Ball(rows.t[i]));
    evaluator(y, out);
    error = std::max(error, distance(out[0], values[i]));
  }
  return error;
}

}  // namespace qdot
