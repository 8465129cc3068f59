#pragma once
// What makes lengths, angles and multipliers comparable, whatever the scene's units are: small departures u
// from a place obey M u'' + K u = g, and in displacements u_i = s_i v_i with M_ii s_i^2 = 1 K's entries are
// squares of rates, and the v of one size.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace qdot {

/// A place x with the forces g there, K = dg/dx and M.
struct PlaceWithForces {
  Eigen::VectorXd x, forces;
  Eigen::MatrixXd stiffness, inertia;
  std::function<std::optional<Eigen::MatrixXd>(const Eigen::VectorXd& x)> stiffness_at;
};

/// s. What has no inertia, as a multiplier, is measured by what it does to the others: the largest entry in
/// its row becomes the largest that they have among themselves.
[[nodiscard]] Eigen::VectorXd comparable_units(const Eigen::MatrixXd& stiffness,
                                               const Eigen::MatrixXd& inertia);

/// What displacements from x count as large: 1 for angles, |x_i| for other coordinates where that is not 0,
/// and where it is, the largest of the others in displacements v, though not more than the largest in the
/// same unit; if all are 0, as far as the forces would have to go to change by all they are. 1 where there
/// are none.
[[nodiscard]] Eigen::VectorXd sizes_at(const PlaceWithForces& place,
                                       const std::vector<std::string>& scene_units);

}  // namespace qdot
