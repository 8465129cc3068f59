#include "core/steady/comparable_units.hpp"

#include <algorithm>
#include <cmath>

namespace qdot {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd comparable_units(const MatrixXd& stiffness, const MatrixXd& inertia) {
  const Eigen::Index n = stiffness.rows();
  const MatrixXd size = stiffness.cwiseAbs().cwiseMax(stiffness.transpose().cwiseAbs());
  VectorXd units = VectorXd::Zero(n);  // 0 as long as it is not known
  for (Eigen::Index i = 0; i < n; ++i)
    if (inertia(i, i) > 0) units[i] = 1 / std::sqrt(inertia(i, i));
  const auto acting_on = [&](Eigen::Index i) {
    return size.row(i).transpose().cwiseProduct(units).maxCoeff();
  };
  double among = 0;
  for (Eigen::Index i = 0; i < n; ++i) among = std::max(among, units[i] * acting_on(i));
  if (among == 0) among = 1;
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    VectorXd next = units;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double per_unit = std::max(acting_on(i) / among, std::sqrt(size(i, i) / among));
      if (units[i] != 0 || !(per_unit > 0)) continue;
      next[i] = 1 / per_unit;
      goes_on = goes_on || next[i] > 0;
    }
    units = next;
  }
  return (units.array() > 0).select(units, 1);
}

VectorXd sizes_at(const PlaceWithForces& place, const std::vector<bool>& is_angle) {
  const VectorXd units = comparable_units(place.stiffness, place.inertia);
  const Eigen::Index n = units.size();
  VectorXd sizes = place.x.cwiseAbs();
  for (Eigen::Index i = 0; i < n; ++i)
    if (is_angle[static_cast<std::size_t>(i)]) sizes[i] = 1;
  double largest = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    if (place.inertia(i, i) > 0) largest = std::max(largest, sizes[i] / units[i]);
  if (largest == 0) {
    const MatrixXd scaled = units.asDiagonal() * place.stiffness * units.asDiagonal();
    largest = units.cwiseProduct(place.forces).norm() / scaled.norm();
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    if (sizes[i] != 0) continue;
    sizes[i] = units[i] * largest;
    if (!(sizes[i] > 0) || !std::isfinite(sizes[i])) sizes[i] = 1;
  }
  return sizes;
}

}  // namespace qdot
