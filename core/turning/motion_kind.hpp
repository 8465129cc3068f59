#pragma once
// The kinds of motion of one coordinate, and the sentences about them and their bounds.

#include <string>

#include "core/numerics/finding.hpp"
#include "core/turning/turning_search.hpp"

namespace qdot {

/// libration: to and fro between two turning points. rotation: an angle that never turns. separatrix: the
/// energy is that of a maximum of U, as far as numbers can tell. unbounded: it never turns on one side.
enum class MotionKind { libration, rotation, separatrix, equilibrium, unbounded };

/// The extremum of the coordinate `name` at a bound: its value, or why there is none, or what else has to be
/// said of it.
[[nodiscard]] Finding extremum_at(const MotionBound& bound, const std::string& name);

/// Why a motion of this kind has no period.
[[nodiscard]] std::string why_not_periodic(MotionKind kind);

/// Why nothing can be told of rest on `name` where the force has no sign.
[[nodiscard]] std::string why_rest_is_undecided(const std::string& name);

}  // namespace qdot
