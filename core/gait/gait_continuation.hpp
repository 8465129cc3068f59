#pragma once
// Where gaits appear, vanish and lose their stability as one parameter changes.
//
// The gaits of a scene, R(u, T; p) = 0 (core/gait/shooting.hpp), form curves in (u, T, p).
// Each is followed by its arclength, through folds (core/gait/gait_family.hpp),
// and a critical value is a zero along it of
//
//   det(D + 1)               period doubling: a multiplier is -1
//   det(D - 1)               fold: a multiplier is 1, and two gaits meet
//   prod_{i<j} (m_i m_j - 1) Neimark-Sacker: a pair of multipliers exp(+-i a), not real
//
// with D = dP/du and its eigenvalues m_i. Source: Yu. A. Kuznetsov, Elements of
// Applied Bifurcation Theory, 3rd ed., Springer 2004, sections 4.2, 5.4 and 10.2.

#include <complex>
#include <span>
#include <string>
#include <vector>

#include "core/gait/gait.hpp"

namespace qdot {

/// In SI units, beside the parameter's own.
struct GaitPoint {
  double parameter{};
  std::vector<double> state;  ///< q, q' just after the impact
  double step_time{};
  std::vector<std::complex<double>> multipliers;  ///< largest first
  bool stable{};                                  ///< all of them inside the unit circle
};

struct GaitBranch {
  Gait::Kind kind{};              ///< where the branch was found first; through a fold short becomes long
  std::vector<GaitPoint> points;  ///< along the curve
};

struct CriticalGait {
  enum class Kind { period_doubling, fold, neimark_sacker };
  Kind kind{};
  double value{};  ///< of the parameter
  double error{};  ///< twice the difference from the same with ten times the tolerance, and what Newton's
                   ///< method leaves
  std::vector<double> state;  ///< of the gait there, just after the impact
  double step_time{};
  std::vector<std::complex<double>> multipliers;
};

struct GaitBifurcations {
  std::vector<CriticalGait> critical;  ///< ascending values
  std::vector<GaitBranch> branches;
  std::string reason;  ///< why there is no branch
};

/// Critical values of parameter number `index` in [from, to], from < to, the others as given. Branches are
/// those that start from a gait found at one of nine equidistant values, both ends among them, and end where
/// the parameter leaves the range or the stride no longer closes with the impact. Throws
/// Error(not_applicable) as SectionMap does.
[[nodiscard]] GaitBifurcations critical_gaits(const Dynamics& dynamics, std::span<const double> parameters,
                                              std::size_t index, double from, double to);

}  // namespace qdot
