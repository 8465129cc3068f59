#include "core/gait/shooting.hpp"

#include <cmath>

#include "core/numerics/dense_matrix.hpp"

namespace qdot {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int most_newton_steps = 20;
constexpr double longest_newton_step = 0.5;  // of the unknowns

}  // namespace

std::optional<Shooting> shoot(SectionMap& map, const Recurrence& at, double rtol) {
  auto flow = map.flow(at.u, at.duration, rtol);
  if (!flow) return std::nullopt;
  const Index k = map.size();
  const double norm = flow->surface_slope.norm();
  if (!(norm > 0)) return std::nullopt;
  Shooting shooting{{}, VectorXd(k + 1), Eigen::MatrixXd(k + 1, k + 1)};
  shooting.residual << map.section(flow->state) - at.u, flow->surface / norm;
  for (Index j = 0; j < k; ++j) {
    shooting.derivative.col(j) << map.section(flow->derivative.col(j)),
        flow->surface_slope.dot(flow->derivative.col(j)) / norm;
    shooting.derivative(j, j) -= 1;
  }
  shooting.derivative.col(k) << map.section(flow->rate), flow->surface_slope.dot(flow->rate) / norm;
  shooting.flow = std::move(*flow);
  return shooting;
}

std::optional<Recurrence> solve_recurrence(SectionMap& map, Recurrence at, double rtol, double accuracy) {
  const Index k = map.size();
  for (int i = 0; i < most_newton_steps; ++i) {
    const auto shooting = shoot(map, at, rtol);
    if (!shooting) return std::nullopt;
    const VectorXd step = solve(shooting->derivative, -shooting->residual);
    if (!step.allFinite()) return std::nullopt;
    const double size = std::max(step.head(k).norm() / at.u.norm(), std::abs(step[k]) / at.duration);
    const double share = std::min(1.0, longest_newton_step / size);
    at.u += share * step.head(k);
    at.duration += share * step[k];
    if (size < accuracy) return at;
  }
  return std::nullopt;
}

}  // namespace qdot
