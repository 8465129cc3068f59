#include "core/motion/column_errors.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/work.hpp"

namespace qdot {
namespace {

/// Bound of |x - value| for every x in the ball.
double distance(const Ball& ball, const DoubleDouble& value) {
  const double bound = (ball - Ball(value, 0)).magnitude();
  return std::isfinite(bound) ? bound : infinity;
}

/// What jumps where a kink of the equations is crossed.
bool jumps(const Dynamics& dynamics, const Column& column) {
  const Symbols& symbols = dynamics.model().parsed.symbols;
  return dynamics.kinks() != nullptr && (depends_on(column.value, symbols.coordinates.second_rate) ||
                                         depends_on(column.value, symbols.multipliers));
}

}  // namespace

Ball instant(double t) { return {DoubleDouble(t), std::abs(t) * 0x1p-53}; }
Ball instant(const Real& t) { return {t.double_double(), t.error + std::abs(t.value) * 0x1p-104}; }

ColumnErrors::ColumnErrors(const Dynamics& dynamics, const std::vector<Column>& columns,
                           const Reals& parameters)
    : function_(dynamics.columns(columns)),
      evaluator_(*function_, parameters.as<Ball>()),
      found_(columns.size()) {
  for (const Column& column : columns) largest_.push_back(jumps(dynamics, column) ? infinity : 0);
}

void ColumnErrors::add(const Ball& t, std::span<const Ball> y, std::span<const DoubleDouble> values) {
  evaluator_.set_time(t);
  evaluator_(y, found_);
  for (std::size_t k = 0; k < found_.size(); ++k)
    largest_[k] = std::max(largest_[k], distance(found_[k], values[k]));
}

std::vector<double> column_errors(const Dynamics& dynamics, const std::vector<Column>& columns,
                                  const Reals& parameters, const RowsWithErrors& rows,
                                  std::span<const std::span<const double>> values) {
  if (columns.empty()) return {};
  ColumnErrors errors(dynamics, columns, parameters);
  const std::size_t width = rows.errors.size();
  std::vector<Ball> y(width);
  std::vector<DoubleDouble> row(columns.size());
  for (std::size_t i = 0; i < values[0].size(); ++i) {
    if (i % 256 == 0) check_interruption();
    for (std::size_t k = 0; k < width; ++k)
      y[k] = Ball(DoubleDouble(rows.states[i * width + k]), rows.errors[k]);
    for (std::size_t k = 0; k < row.size(); ++k) row[k] = DoubleDouble(values[k][i]);
    errors.add(instant(rows.t[i]), y, row);
  }
  return errors.largest();
}

std::vector<double> value_errors(const CompiledFunction& function, const Reals& parameters, double t,
                                 const Reals& y, std::span<const double> values) {
  const std::vector<Ball> constants = parameters.as<Ball>();
  TapeEvaluator<Ball> evaluator(function, constants);
  evaluator.set_time(instant(t));
  std::vector<Ball> found(values.size());
  evaluator(y.as<Ball>(), found);
  std::vector<double> errors;
  for (std::size_t k = 0; k < values.size(); ++k)
    errors.push_back(distance(found[k], DoubleDouble(values[k])));
  return errors;
}

}  // namespace qdot
