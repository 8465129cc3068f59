#pragma once
// Where gaits may be: starts for Newton's method on R(u, T) = 0 (core/gait/shooting.hpp).
//
// One equation fewer, section(y(T)) = u for a given T, has a curve of solutions (u, T). It is found by
// Newton's method from the starts u = r (+-1, ..., +-1), all in the scene's units, with r = 0.3 at T = 2, or
// if no gait is found then r = 0.03 and 2, then at T = 1 and 4 (starts that the event's condition excludes
// are left out), and followed from each new solution by its arclength in (u/|u|, log T) over 0.1 <= T <= 6
// and 1e-6 <= |u| <= 1e3 (core/numerics/path_following.hpp). The candidates are the changes of sign of g
// along it. Beside them are the gaits where strides settle that begin as the scene does, or if no gait is
// found with three or ten times its velocities (core/gait/strides_that_settle.hpp). Gaits that neither reach
// are not found.

#include <vector>

#include "core/gait/strides_that_settle.hpp"

namespace qdot {

struct GaitSearch {
  std::vector<Recurrence> candidates;  ///< near all the periodic gaits that are found
  enum class Outcome {
    found,
    nothing_recurs,  ///< no start led to a motion with section(y(T)) = u
    dies_away,       ///< all that were followed shrink towards rest
    no_impact        ///< motions that recur were followed, but g(y(T)) = 0 for none of them
  } outcome{};
};

[[nodiscard]] GaitSearch search_gaits(SectionMap& map, const IgnoredByGait& gait_near);

}  // namespace qdot
