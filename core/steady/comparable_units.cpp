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

namespace {

/// How far each force would have to go to change by all it is, by the stiffness here and where that leads:
/// here alone it may be next to none.
VectorXd reach_of_forces(const PlaceWithForces& place, const VectorXd& units) {
  const VectorXd forces = units.cwiseProduct(place.forces);
  const auto by = [&](const VectorXd& stiffest) -> VectorXd {
    return (stiffest.array() > 0).select(units.cwiseProduct(forces.cwiseAbs().cwiseQuotient(stiffest)), 0);
  };
  const auto stiffest = [&](const MatrixXd& k) -> VectorXd {
    return (units.asDiagonal() * k * units.asDiagonal()).rowwise().norm();
  };
  const VectorXd here = stiffest(place.stiffness), reach = by(here);
  const auto there = place.stiffness_at(place.x - reach.cwiseProduct(forces.cwiseSign()));
  return there && there->allFinite() ? by(here.cwiseMax(stiffest(*there))) : reach;
}

}  // namespace

VectorXd sizes_at(const PlaceWithForces& place, const std::vector<std::string>& scene_units) {
  const VectorXd units = comparable_units(place.stiffness, place.inertia);
  const Eigen::Index n = units.size();
  const auto unit = [&](Eigen::Index i) { return scene_units[static_cast<std::size_t>(i)]; };
  const auto has_inertia = [&](Eigen::Index i) { return place.inertia(i, i) > 0; };
  VectorXd sizes = place.x.cwiseAbs();
  for (Eigen::Index i = 0; i < n; ++i)
    if (unit(i) == "rad") sizes[i] = 1;
  VectorXd known = (place.inertia.diagonal().array() > 0).select(sizes, 0);
  if (known.isZero(0)) known = reach_of_forces(place, units);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (sizes[i] != 0) continue;
    double by_inertia = 0, by_unit = 0;
    for (Eigen::Index j = 0; j < n; ++j) {
      if (!has_inertia(j)) continue;
      by_inertia = std::max(by_inertia, units[i] * known[j] / units[j]);
      if (has_inertia(i) && unit(j) == unit(i)) by_unit = std::max(by_unit, known[j]);
    }
    sizes[i] = by_unit > 0 ? std::min(by_unit, by_inertia) : by_inertia;
    if (!(sizes[i] > 0) || !std::isfinite(sizes[i])) sizes[i] = 1;
  }
  return sizes;
}

}  // namespace qdot
