#pragma once
// Ways on which a motion may go on as well.
//
// At a fork (fork.hpp) the true motion may do otherwise, and be far away afterwards however small the error
// was. All its computations may do the same there, by chance, so that their differences do not tell. So the
// motion is computed once more on the other way. What that differs by is in the errors then: little at a kink
// over which forces are continuous, much where they jump. So it is where several impacts happen within one
// instant, with the opposite order of them.

#include <span>
#include <string>
#include <vector>

#include "core/motion/events_in_doubt.hpp"
#include "core/motion/motion_check.hpp"
#include "core/motion/motion_comparison.hpp"
#include "core/numerics/constants.hpp"

namespace qdot {

struct OtherWays {
  std::vector<Simulation>
      motions;  ///< each as another computation of the motion, with rows from the first on
  /// Where one of them ends, or cannot be followed: later rows may be anywhere.
  double lost_from{infinity};
  std::string where;  ///< the first such place, for a sentence; empty where there is none
  double first_place{infinity};
  /// The first of those at which an impact may happen, or the end of the motion, or may not.
  std::string where_it_happens;
  bool may_not_end{};                 ///< at one of those, or end there after all
  std::vector<double> stated_before;  ///< errors of the last row before it
  std::uint64_t evaluations{};
};

/// `comparison`: of the motion with `others`; `evaluations_left`: for all together.
[[nodiscard]] OtherWays other_ways(const ComputedMotion& motion, std::span<const Simulation> others,
                                   const RowComparison& comparison, std::uint64_t evaluations_left);

/// The beginning of a sentence on impacts at that time.
[[nodiscard]] std::string several_at_once(double t);
/// The same of kinks.
[[nodiscard]] std::string several_kinks_at_once(double t);
[[nodiscard]] std::string kinks_too_fast(double t);

/// The events that the errors allow to happen where the motion nearly meets them; `errors`: of those that it
/// has met, in their order.
[[nodiscard]] std::vector<EventDoubt> events_that_may_happen(
    const ComputedMotion& motion, std::span<const ApproachAsTold> near_events,
    std::span<const std::optional<EventError>> errors);

/// A sentence on what they do to the errors; empty where that is little, and where nothing else may happen.
[[nodiscard]] std::string what_they_change(const OtherWays& ways, const RowComparison& without,
                                           const RowComparison& with);

}  // namespace qdot
