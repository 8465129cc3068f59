#include "core/motion/stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/motion/kink_modes.hpp"
#include "core/numerics/dense_matrix.hpp"

namespace qdot {
namespace {

constexpr double by_far = 4;  ///< faster than every oscillation and growth

/// Only a force that depends on velocities takes energy.
bool may_damp(const Lagrangian& lagrangian) {
  return std::ranges::any_of(lagrangian.generalized_forces, [&](const Expression& force) {
    return depends_on(force, lagrangian.symbols.coordinates.rate);
  });
}

/// The accelerations and what they take as parameters; on the sides of kinks where there are some.
struct Accelerations {
  std::shared_ptr<const CompiledFunction> function;
  std::vector<double> parameters;
};
Accelerations smooth_accelerations(const Dynamics& dynamics, std::span<const double> parameters, double t,
                                   std::span<const double> y) {
  if (dynamics.kinks() == nullptr) {
    return {{std::shared_ptr<void>(), &dynamics.accelerations()}, {parameters.begin(), parameters.end()}};
  }
  KinkModes modes(dynamics, parameters, 0);
  const Sides sides = modes.sides_at(t, y);
  const auto motion = modes.motion(sides);
  return {{motion, &motion->accelerations}, modes.parameters(sides)};
}

/// d(q', q'')/d(q, q') by central differences, good to some digits; without the symbolic one, whose
/// derivation costs more than the motion of most scenes.
Eigen::MatrixXd rough_jacobian(const Dynamics& dynamics, std::span<const double> parameters, double t,
                               std::span<const double> y) {
  const auto [accelerations, with] = smooth_accelerations(dynamics, parameters, t, y);
  Workspace workspace = accelerations->bind(with);
  const std::size_t n = y.size() / 2;
  const auto size = static_cast<Eigen::Index>(y.size());
  const auto half = static_cast<Eigen::Index>(n);
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(size, size);
  jacobian.topRightCorner(half, half).setIdentity();
  std::vector<double> moved(y.begin(), y.end()), ahead(n), behind(n);
  for (std::size_t j = 0; j < y.size(); ++j) {
    const double step = y[j] == 0 ? 1e-6 : 1e-6 * std::abs(y[j]);
    for (double* result : {ahead.data(), behind.data()}) {
      moved[j] = result == ahead.data() ? y[j] + step : y[j] - step;
      if (accelerations->evaluate(t, moved, workspace, {result, n}) != Evaluation::ok) return {};
    }
    moved[j] = y[j];
    for (std::size_t i = 0; i < n; ++i) {
      jacobian(static_cast<Eigen::Index>(n + i), static_cast<Eigen::Index>(j)) =
          (ahead[i] - behind[i]) / (2 * step);
    }
  }
  return jacobian;
}

}  // namespace

double damping_times_span(const Dynamics& dynamics, std::span<const double> parameters, double t,
                          std::span<const double> y, double span) {
  if (!may_damp(dynamics.model().lagrangian)) return 0;
  const Eigen::MatrixXd matrix = rough_jacobian(dynamics, parameters, t, y);
  if (matrix.size() == 0 || !matrix.allFinite()) return 0;
  double damping = 0, others = 0;
  for (const auto& value : eigenvalues(matrix)) {
    damping = std::max(damping, -value.real());
    others = std::max({others, value.real(), std::abs(value.imag())});
  }
  return damping > by_far * others ? damping * span : 0;
}

}  // namespace qdot
