#pragma once
// Where a motion with strong damping comes to rest: the flow down a potential U,
//
//   s' = -dU/ds,   |ds|^2 = dx.M dx
//
// with the inertia M as the measure, so that no coordinates are preferred. A step of time h follows the
// tangent F + k s of dU/ds, and what dU/ds departs from it by, D in the middle and at the end:
//
//   s = -h (phi_1 F + phi_2 D_1 + 2 phi_3 D_2),   D_1 t/h + D_2 (t/h)^2 = D,   phi_j = phi_j(-h k)
//
// It is exact where U is quadratic, becomes Newton's iteration near a minimum, and is so short that D adds
// little. Source: Hochbruck, Ostermann, Exponential integrators, Acta Numerica 19 (2010), 2.

#include <Eigen/Core>
#include <functional>
#include <optional>

namespace qdot {

/// About a place x, in displacements s along the axes of U's curvature there.
struct Slope {
  Eigen::VectorXd curvature;  ///< of each axis, ascending
  Eigen::VectorXd force;      ///< F
  Eigen::MatrixXd axes;       ///< columns dx/ds
  bool is_gradient{true};     ///< the derivative of the forces is symmetric
};

struct Moved {
  Eigen::VectorXd x;
  Eigen::VectorXd force;  ///< dU/ds there
};

/// No values where the forces have none, or the place is not allowed.
struct Hillside {
  std::function<std::optional<Slope>(const Eigen::VectorXd& x)> slope;
  std::function<std::optional<Moved>(const Eigen::VectorXd& x, const Slope& slope, const Eigen::VectorXd& s)>
      moved;
  Eigen::VectorXd sizes;  ///< of each x
};

/// A place within rounding of the one where the flow from `start` ends, which is no minimum where that is on
/// a ridge exactly; no value where it ends in none.
[[nodiscard]] std::optional<Eigen::VectorXd> end_of_flow(const Hillside& hillside,
                                                         const Eigen::VectorXd& start);

/// The largest displacement in units of the sizes.
[[nodiscard]] double largest_part(const Eigen::VectorXd& displacement, const Eigen::VectorXd& sizes);

}  // namespace qdot
