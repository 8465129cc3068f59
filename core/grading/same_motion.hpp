#pragma once
// Whether equations that were submitted have the solutions of the right ones, M q'' = f, whatever their form.
//
// An equation r(q, q', q'', t) = 0 is compared by what it says of the motion, not by its terms: r has to
// vanish on the right accelerations at every state, and to determine an acceleration there. So it may be
// scaled, divided, rearranged, or have other equations put into it, and 0 = 0 is no equation. With a =
// dr/dq'' the equation is c (M q'' - f) = 0, c M = a; it is that of coordinate i where it speaks of q_i'' and
// c_i is not zero, because then it says the same as the right one together with those of the other
// coordinates. As many equations as coordinates are right together where det dr/dq'' is not zero. What is not
// linear in the accelerations must have no other solution (other_solutions.hpp).
//
// Under constraints the same is said of S u = r, u the accelerations and the multipliers, at states on the
// surface. There an equation of positions or velocities that holds is a constraint or follows from some, and
// counts as its derivative does. Equations are right together where they determine, with those of the
// constraints, the accelerations and the multipliers that they speak of: so multipliers may be eliminated.
// The sign of one that is only called lambda is free, if it is the same everywhere.

#include <optional>
#include <span>

#include "core/grading/expected_system.hpp"
#include "core/grading/linear_equations.hpp"
#include "core/grading/vanishing.hpp"

namespace qdot {

struct MotionVerdict {
  MotionFault fault{MotionFault::undecided};
  Decision decided_by{Decision::unknown};
  std::size_t equation{};  ///< which one is at fault
  State counterexample{};
  /// For one coordinate: q'' there, as the submission has it.
  std::optional<double> acceleration{};
};

/// `residuals`: left - right of each equation, fixed parameters put in. `coordinate`: whose equation it is;
/// none: all of them are asked for, and there are as many residuals as coordinates, if nothing constrains
/// them. `tolerance` is that of
/// rounded numbers, as a part of the sizes of the right equations' terms.
[[nodiscard]] MotionVerdict compare_motion(const ExpectedSystem& system,
                                           std::span<const Expression> residuals,
                                           std::optional<std::size_t> coordinate, std::uint64_t seed,
                                           double tolerance = 0);

}  // namespace qdot
