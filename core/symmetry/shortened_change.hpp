#pragma once
// A symmetry as it is written: what it keeps is the same times a constant, and on the constraints F may be
// another with the same value.

#include "core/symmetry/point_change.hpp"

namespace qdot {

/// With tau = 1 where the time is changed at all, so that h has no factor.
[[nodiscard]] PointChange with_unit_of_time(const PointChange& change, const Symbols& symbols);

/// The shortest F that is the same up to a constant where the constraints phi = 0 hold: F less the multiple
/// of a phi that leaves one coordinate out.
[[nodiscard]] Expression gauge_on_constraints(const Expression& gauge, const Lagrangian& lagrangian);

/// sum A_i q_i + b t of the constraints in the velocities whose A and b are constant: these keep it constant.
[[nodiscard]] std::vector<Expression> integrals_of_constraints(const Lagrangian& lagrangian);

/// Whether one is a multiple of the other by a constant, as the expressions stand.
[[nodiscard]] bool is_multiple(const Expression& a, const Expression& b, const Symbols& symbols);

}  // namespace qdot
