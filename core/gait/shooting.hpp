#pragma once
// Periodic gaits as zeros of k + 1 functions of the k components u before an impact and the duration T:
//
//   R(u, T) = [ section(y(T)) - u,  g(y(T)) / |dg/dy| ],   y(0) = G(u)      (core/gait/section_map.hpp)
//
// No event is searched for, so that R is smooth wherever the motion is, while the section map itself exists
// on a thin set of states only: a walker that is a little too fast or too slow falls. Whether the impact at
// T is the next one is asked afterwards. Source: U. M. Ascher, R. M. M. Mattheij, R. D. Russell, Numerical
// Solution of Boundary Value Problems for Ordinary Differential Equations, SIAM 1995, section 4.1.

#include <Eigen/Core>
#include <optional>

#include "core/gait/section_map.hpp"

namespace qdot {

/// An unknown (u, T).
struct Recurrence {
  Eigen::VectorXd u;
  double duration{};
};

struct Shooting {
  Flow flow;
  Eigen::VectorXd residual;    ///< k + 1
  Eigen::MatrixXd derivative;  ///< d residual/d(u, T), (k + 1) x (k + 1)
};
[[nodiscard]] std::optional<Shooting> shoot(SectionMap& map, const Recurrence& at, double rtol);

/// Newton's method from `at` for R = 0, until a correction falls below `accuracy` of the unknowns; steps are
/// cut to half of them. No value if that does not happen within 20 steps.
[[nodiscard]] std::optional<Recurrence> solve_recurrence(SectionMap& map, Recurrence at, double rtol,
                                                         double accuracy);

}  // namespace qdot
