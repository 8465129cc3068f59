#pragma once
// Periodic gaits: motions that an impact brings back to where the impact before left them, that is fixed
// points u = P(u) of the section map (core/gait/section_map.hpp), of period 1.
//
// They are stable when all multipliers, the eigenvalues of dP/du, lie inside the unit circle. Of as many
// multipliers as there are components only those of the section's own dimension are given: an impact that
// forgets part of the state makes the others 0.
//
// A stride may cross the impact's surface earlier in the impact's direction, at a place where its condition
// does not hold. Gaits with more such crossings than others are left out: a walker that stands nearly upright
// while its swing leg swings to and fro through the floor. There are infinitely many of those, with
// multipliers of e^9 and more.
//
// Source: M. Garcia, A. Chatterjee, A. Ruina, M. Coleman, The simplest walking model: stability, complexity,
// and scaling, J. Biomech. Eng. 120 (1998) 281-288; T. McGeer, Passive dynamic walking, Int. J. Robotics
// Research 9 (1990) 62-82.

#include <complex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/gait/shooting.hpp"

namespace qdot {

/// A number with a bound of its error: twice the difference from a second computation with ten times the
/// tolerance, and the rounding of the first, both carried through (I - dP/du)^-1.
struct Uncertain {
  double value{};
  double error{};
};

enum class GaitStability {
  stable,
  unstable,
  undecided  ///< the largest multiplier has the magnitude 1 within its error
};

/// In SI units.
struct Gait {
  enum class Kind { short_step, long_step, other };
  /// Of the gaits of one system the one with the shortest and the one with the second shortest step time;
  /// `other` for any more, and where there is only one.
  Kind kind{Kind::other};
  std::vector<Uncertain> state;       ///< q, q' just after the impact
  std::vector<Uncertain> pre_impact;  ///< just before it
  Uncertain step_time;
  /// How far an impact moves the origin of the scene's points, as from the old foot to the new: after an
  /// impact that relabels the legs, all points are where others were, shifted. Without a value where they
  /// are not, or not shifted.
  std::optional<Uncertain> step_length;
  std::vector<std::complex<double>> multipliers;  ///< largest first
  std::vector<double> multiplier_errors;
  GaitStability stability{};
  int ignored_crossings{};  ///< as in Stride
  double residual{};  ///< the largest component of |G(P(u)) - G(u)|, by following the motion to its event
};

struct Gaits {
  std::vector<Gait> gaits;  ///< by step time
  std::string reason;       ///< why there is none
};

/// All that are found (core/gait/gait_search.hpp says how). Throws Error(not_applicable) as SectionMap does.
[[nodiscard]] Gaits periodic_gaits(const Dynamics& dynamics, std::span<const double> parameters);

/// A gait in the scene's units, as far as double precision holds it, and how far that is.
struct PolishedGait {
  Recurrence at;
  Eigen::VectorXd error;    ///< of u, then of T
  Flow flow;                ///< at (u, T)
  Flow coarser;             ///< at the same place, with ten times the tolerance
  Eigen::MatrixXd section;  ///< dP/du
};

/// Newton's method from a gait that is nearly known. No value where it fails or (u, T) is no impact.
[[nodiscard]] std::optional<PolishedGait> polished(SectionMap& map, const Recurrence& near);

struct Multipliers {
  std::vector<std::complex<double>> values;  ///< largest first
  std::vector<double> errors;
};
[[nodiscard]] Multipliers multipliers(SectionMap& map, const PolishedGait& gait);
[[nodiscard]] GaitStability stability(const Multipliers& multipliers);

}  // namespace qdot
