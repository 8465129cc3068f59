#pragma once
// An equilibrium that symmetries lead away from is one of a family. With r independent changes xi_k(x) that
// leave U as it is (symmetric_changes.hpp) there are r coordinates P whose part xi_P, r x r, has an inverse.
// Held where they are, the forces on the others have one zero nearby (equilibrium_enclosure.hpp); and since
//
//   sum_i xi_k,i g_i = 0 identically,
//
// those on P vanish with them: it is an equilibrium, and the only ones nearby are those to which the changes
// take it.

#include "core/steady/equilibrium_enclosure.hpp"

namespace qdot {

/// The member of the family that `degenerate` (equilibrium_enclosure.hpp) lies near, with directions to the
/// others. Coordinates held are those of `guess`, where that is as near as rounding. Where more than the
/// family leaves K singular, `degenerate` itself with the directions; and as it is where there are none.
[[nodiscard]] Equilibrium with_family(const Statics& statics, std::span<const Ball> constants,
                                      const NearlyEquilibrium& near, const Eigen::VectorXd& guess,
                                      Equilibrium degenerate);

}  // namespace qdot
