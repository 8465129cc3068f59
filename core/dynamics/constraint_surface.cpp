#include "core/dynamics/constraint_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/dynamics/motion_functions.hpp"
#include "core/expr/polynomial.hpp"
#include "core/numerics/linear_system.hpp"

namespace qdot {

ConstraintSurface::ConstraintSurface(const Model& model, const InputTexts& inputs)
    : n_(model.degrees_of_freedom()), m_(model.lagrangian.constraints.size()) {
  const Lagrangian own = copied(model.lagrangian);
  std::vector<Expression> outputs, residuals;
  for (const auto& row : mass_matrix(own)) outputs.insert(outputs.end(), row.begin(), row.end());
  for (const ConstraintEquation& constraint : own.constraints)
    outputs.insert(outputs.end(), constraint.slope.begin(), constraint.slope.end());
  for (std::size_t j = 0; j < m_; ++j) {
    if (!own.constraints[j].position) continue;
    position_of_.push_back(j);
    residuals.push_back(*own.constraints[j].position);
  }
  for (const ConstraintEquation& constraint : own.constraints) residuals.push_back(constraint.rate);
  outputs.insert(outputs.end(), residuals.begin(), residuals.end());
  for (const Expression& residual : residuals) {
    for (const Expression& term : terms_of(residual)) outputs.push_back(term);
    ends_of_terms_.push_back(outputs.size());
  }
  values_ =
      std::make_unique<const CompiledFunction>(compiled_along_motion(model, inputs, *own.graph, outputs));
}

ConstrainedStates::ConstrainedStates(const ConstraintSurface& surface, std::span<const double> parameters)
    : surface_(surface),
      workspace_(surface.values().bind(parameters)),
      values_(surface.values().outputs()),
      all_rows_(surface.constraints()) {
  std::iota(all_rows_.begin(), all_rows_.end(), std::size_t{0});
}

bool ConstrainedStates::evaluate(double t, std::span<const double> y) {
  return surface_.values().evaluate(t, y, workspace_, values_) == Evaluation::ok;
}

std::span<const double> ConstrainedStates::residuals() const {
  return std::span(values_).subspan(surface_.first_residual(), surface_.positions() + surface_.constraints());
}

double ConstrainedStates::size_of_terms(std::size_t k, std::span<const double> y) const {
  const std::size_t n = surface_.coordinates(), positions = surface_.positions();
  const std::size_t row = k < positions ? surface_.position_of()[k] : k - positions;
  double size = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double slope = values_[surface_.first_slope() + row * n + i];
    size += std::abs(slope * y[k < positions ? i : n + i]);
  }
  const std::vector<std::size_t>& ends = surface_.ends_of_terms();
  const std::size_t begin =
      k > 0 ? ends[k - 1] : surface_.first_residual() + positions + surface_.constraints();
  for (std::size_t i = begin; i < ends[k]; ++i) size = std::max(size, std::abs(values_[i]));
  return size;
}

double ConstrainedStates::change(std::size_t k, std::span<const double> step) const {
  const auto slope = std::span(values_).subspan(
      surface_.first_slope() + surface_.position_of()[k] * surface_.coordinates(), surface_.coordinates());
  return std::inner_product(slope.begin(), slope.end(), step.begin(), 0.0);
}

bool ConstrainedStates::step(std::span<const std::size_t> rows, std::span<const double> residuals,
                             const std::vector<bool>& free, std::span<double> step) const {
  const std::size_t n = surface_.coordinates();
  std::ranges::fill(step, 0.0);
  if (rows.empty()) return true;
  std::vector<std::size_t> moved;
  for (std::size_t i = 0; i < n; ++i) {
    if (free[i]) moved.push_back(i);
  }
  const std::size_t size = moved.size() + rows.size();
  if (rows.size() > moved.size() || size > largest_system) return false;
  std::vector<double> matrix(size * size), right(size);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    for (std::size_t k = 0; k < moved.size(); ++k) matrix[i * size + k] = values_[moved[i] * n + moved[k]];
    for (std::size_t j = 0; j < rows.size(); ++j) {
      const double slope = values_[surface_.first_slope() + rows[j] * n + moved[i]];
      matrix[i * size + moved.size() + j] = matrix[(moved.size() + j) * size + i] = slope;
    }
  }
  for (std::size_t j = 0; j < rows.size(); ++j) right[moved.size() + j] = -residuals[j];
  if (!solve_linear(size, matrix, right)) return false;
  for (std::size_t i = 0; i < moved.size(); ++i) step[moved[i]] = right[i];
  return std::ranges::all_of(step, [](double x) { return std::isfinite(x); });
}

bool ConstrainedStates::step_of_positions(std::span<const double> phi, const std::vector<bool>& free,
                                          std::span<double> step) const {
  return this->step(surface_.position_of(), phi, free, step);
}

bool ConstrainedStates::step_of_rates(std::span<const double> w, const std::vector<bool>& free,
                                      std::span<double> step) const {
  return this->step(all_rows_, w, free, step);
}

bool ConstrainedStates::project(double t, std::span<double> y) {
  const std::size_t n = surface_.coordinates(), positions = surface_.positions();
  const std::vector<bool> all(n, true);
  std::vector<double> step(n);
  if (positions > 0) {
    if (!evaluate(t, y) || !step_of_positions(residuals().first(positions), all, step)) return false;
    for (std::size_t i = 0; i < n; ++i) y[i] += step[i];
  }
  if (!evaluate(t, y) || !step_of_rates(residuals().subspan(positions), all, step)) return false;
  for (std::size_t i = 0; i < n; ++i) y[n + i] += step[i];
  return true;
}

}  // namespace qdot
