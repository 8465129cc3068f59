#include "core/motion/drift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/work.hpp"
#include "core/dynamics/constraint_surface.hpp"

namespace qdot {
namespace {

/// Of the terms of a constraint: what rounding leaves of it, and no more.
constexpr double kept_by_impacts = 1e-9;

std::span<const double> row_of(std::span<const double> states, std::size_t i, std::size_t width) {
  return states.subspan(i * width, width);
}

}  // namespace

std::vector<double> conserved_changes(const Dynamics& dynamics, const SimulationRequest& request,
                                      std::span<const double> states, std::span<const Segment> segments,
                                      std::size_t every) {
  const auto conserved = dynamics.conserved(request.parameters);
  const std::size_t count = conserved->quantities.size(), width = request.y_start.size();
  const std::size_t rows = states.size() / width;
  if (count == 0 || rows == 0) return {};
  Workspace workspace = conserved->values->bind(request.parameters);
  const auto evaluate = [&](double t, std::span<const double> y, std::span<double> out) {
    if (conserved->values->evaluate(t, y, workspace, out) == Evaluation::ok) return;
    std::ranges::fill(out, std::numeric_limits<double>::quiet_NaN());
  };
  const std::size_t first = (rows - 1) % every;
  std::vector<double> reference(count), changes((1 + (rows - 1 - first) / every) * count);
  std::span<double> change(changes);
  for (std::size_t i = first, next = 0; i < rows; i += every, change = change.subspan(count)) {
    if (i % 256 == 0) check_interruption();
    for (; next < segments.size() && segments[next].first_row <= i; ++next) {
      evaluate(segments[next].t, segments[next].y, reference);
    }
    evaluate(request.grid[i], row_of(states, i, width), change.first(count));
    for (std::size_t k = 0; k < count; ++k) change[k] = next > 0 ? std::abs(change[k] - reference[k]) : 0;
  }
  return changes;
}

std::vector<ConservedRecord> conserved_records(const Dynamics& dynamics, const SimulationRequest& request,
                                               std::span<const double> changes) {
  if (changes.empty()) return {};
  const auto conserved = dynamics.conserved(request.parameters);
  const std::size_t count = conserved->quantities.size();
  std::vector<double> initial(count), drift(count);
  Workspace workspace = conserved->values->bind(request.parameters);
  if (conserved->values->evaluate(request.t_start, request.y_start, workspace, initial) != Evaluation::ok)
    return {};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    if (std::isnan(changes[i])) return {};
    drift[i % count] = std::max(drift[i % count], changes[i]);
  }
  std::vector<ConservedRecord> records;
  for (std::size_t k = 0; k < count; ++k) {
    const ConservedQuantity& quantity = conserved->quantities[k];
    ConservedRecord& record = records.emplace_back();
    record = {quantity.name, quantity.unit, initial[k], drift[k], {}};
    const double relative = drift[k] / std::abs(initial[k]);
    if (std::isfinite(relative)) record.max_rel_drift = relative;
  }
  return records;
}

std::vector<ConstraintRecord> constraints_along(const Dynamics& dynamics, const SimulationRequest& request,
                                                std::span<const double> all) {
  const ConstraintSurface* surface = dynamics.constraint_surface();
  if (surface == nullptr) return {};
  const std::size_t width = request.y_start.size();
  ConstrainedStates states(*surface, request.parameters);
  std::vector<ConstraintRecord> records;
  for (const Constraint& constraint : dynamics.model().scene.constraints)
    records.push_back({constraint.name, {}, 0});
  for (const std::size_t j : surface->position_of()) records[j].max_abs_value = 0;
  for (std::size_t i = 0; i < all.size() / width; ++i) {
    if (!states.evaluate(request.grid[i], row_of(all, i, width))) continue;
    const std::span<const double> residuals = states.residuals();
    std::size_t k = 0;
    for (const std::size_t j : surface->position_of()) {
      double& value = *records[j].max_abs_value;
      value = std::max(value, std::abs(residuals[k++]));
    }
    for (ConstraintRecord& record : records)
      record.max_abs_rate = std::max(record.max_abs_rate, std::abs(residuals[k++]));
  }
  return records;
}

bool keeps_constraints(const Dynamics& dynamics, const SimulationRequest& request, double t,
                       std::span<const double> before, std::span<const double> after) {
  const ConstraintSurface* surface = dynamics.constraint_surface();
  if (surface == nullptr) return true;
  ConstrainedStates states(*surface, request.parameters);
  if (!states.evaluate(t, before)) return true;
  const std::vector<double> left(states.residuals().begin(), states.residuals().end());
  bool keeps = states.evaluate(t, after);
  for (std::size_t k = 0; keeps && k < left.size(); ++k) {
    const double allowed = kept_by_impacts * states.size_of_terms(k, after) + 2 * std::abs(left[k]);
    keeps = std::abs(states.residuals()[k]) <= allowed;
  }
  return keeps;
}

}  // namespace qdot
