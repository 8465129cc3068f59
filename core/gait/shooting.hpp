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
#include <vector>

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

/// Starts for solve_recurrence, near all the periodic gaits that are found.
struct Search {
  std::vector<Recurrence> candidates;
  enum class Outcome {
    found,
    nothing_recurs,  ///< no start led to a motion with section(y(T)) = u
    dies_away,       ///< all that were followed shrink towards rest
    no_impact        ///< motions that recur were followed, but g(y(T)) = 0 for none of them
  } outcome{};
};

/// How they are chosen: one equation fewer, section(y(T)) = u for a given T, has a curve of solutions (u, T).
/// It is found by Newton's method from the starts u = r (+-1, ..., +-1), all in the scene's units, with r =
/// 0.3 at T = 2, or if that fails r = 0.03, then at T = 1 and 4 (those are left out that the event's
/// condition excludes), and followed from each new solution by its arclength in (u/|u|, log T) over 0.1 <= T
/// <= 8 and 1e-6 <= |u| <= 1e3. The candidates are the changes of sign of g along it. Gaits that no such
/// curve reaches are not found. Source: E. L. Allgower, K. Georg, Introduction to Numerical Continuation
/// Methods, SIAM 2003, chapters 2 and 6.
[[nodiscard]] Search search_gaits(SectionMap& map);

}  // namespace qdot
