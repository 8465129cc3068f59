#pragma once
// What equations that hold on the right motion say of it, where they are linear in the accelerations (and
// multipliers) u: with dr/du = c M at states of that motion, c tells of which of the right equations M u = f
// each is made (same_motion.hpp).

#include <cstdint>
#include <optional>
#include <span>

#include "core/grading/expected_system.hpp"
#include "core/grading/right_motion.hpp"

namespace qdot {

enum class MotionFault {
  none,
  not_true,          ///< the right motion does not obey it; see the counterexample
  holds_always,      ///< it says nothing of the accelerations, and every motion obeys it
  of_constraints,    ///< it is a constraint, or follows from the constraints alone
  other_coordinate,  ///< it is true, but says nothing of this coordinate's equation
  other_solutions,   ///< it holds for other motions, too; see the counterexample
  dependent,         ///< the equations follow from fewer of them
  undetermined,      ///< with the constraints they leave accelerations or multipliers free
  not_linear,        ///< in the accelerations, and what else it allows cannot be told
  undecided          ///< too few states where everything has a value
};

/// Whether dr/du is zero for all unknowns.
[[nodiscard]] bool has_no_slope(const Expression& residual, std::span<const Expression> unknowns);

/// Of the equation of one coordinate, or of all together.
[[nodiscard]] MotionFault fault_of_linear(const ExpectedSystem& system, RightMotion& right,
                                          std::span<const Expression> residuals,
                                          std::optional<std::size_t> coordinate, std::uint64_t seed);

}  // namespace qdot
