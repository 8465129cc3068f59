#include "core/steady/model_conditions.hpp"

#include <algorithm>

#include "core/compile/tape_evaluator.hpp"

namespace qdot {
namespace {

std::vector<double> numbers_in(std::span<const Ball> balls) {
  std::vector<double> values;
  for (const Ball& ball : balls) values.push_back(ball.value());
  return values;
}

}  // namespace

std::vector<Ball> model_conditions(const Dynamics& dynamics, std::span<const Ball> parameters,
                                   std::span<const Ball> y) {
  const std::vector<Column> columns = validity_columns(dynamics.model());
  if (columns.empty()) return {};
  const auto of_scene = parameters.first(dynamics.model().scene.parameters.size());
  std::vector<Ball> found(columns.size());
  TapeEvaluator<Ball>(*dynamics.columns(columns), of_scene)(y, found);
  if (std::ranges::all_of(found, &Ball::is_finite)) return found;
  const std::vector<double> values = values_at(dynamics, columns, numbers_in(of_scene), 0, numbers_in(y));
  for (std::size_t i = 0; i < values.size(); ++i) found[i] = Ball(DoubleDouble(values[i]), infinity);
  return found;
}

bool conditions_hold(std::span<const Ball> conditions) {
  return std::ranges::all_of(
      conditions, [](const Ball& c) { return (c.is_finite() && c.contains_zero()) || c.middle.high >= 0; });
}

}  // namespace qdot
