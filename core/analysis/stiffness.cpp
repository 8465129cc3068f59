#include "core/analysis/stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/analysis/dense_matrix.hpp"

namespace qdot {
namespace {

constexpr double by_far = 4;  ///< faster than every oscillation and growth

/// Only a force that depends on velocities takes energy.
bool may_damp(const Lagrangian& lagrangian) {
  return std::ranges::any_of(lagrangian.generalized_forces, [&](const Expression& force) {
    return depends_on(force, lagrangian.symbols.coordinates.rate);
  });
}

}  // namespace

double damping_times_span(const Dynamics& dynamics, std::span<const double> parameters, double t,
                          std::span<const double> y, double span) {
  if (!may_damp(dynamics.model().lagrangian)) return 0;
  const CompiledFunction& jacobian = dynamics.jacobian();
  Workspace workspace = jacobian.bind(parameters);
  std::vector<double> entries(jacobian.outputs());
  if (jacobian.evaluate(t, y, workspace, entries) != Evaluation::ok) return 0;
  const auto n = static_cast<Eigen::Index>(y.size());
  const Eigen::MatrixXd matrix = Eigen::Map<const Eigen::MatrixXd>(entries.data(), n, n).transpose();
  if (!matrix.allFinite()) return 0;
  double damping = 0, others = 0;
  for (const auto& value : eigenvalues(matrix)) {
    damping = std::max(damping, -value.real());
    others = std::max({others, value.real(), std::abs(value.imag())});
  }
  return damping > by_far * others ? damping * span : 0;
}

}  // namespace qdot
