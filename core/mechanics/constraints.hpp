#pragma once
// Constraints and the forces that keep them.
//
//   holonomic          phi_j(q, t) = 0,  so w_j = d(phi_j)/dt = 0 and dw_j/dt = 0
//   in the velocities  w_j(q, q', t) = 0, so dw_j/dt = 0
//   w_j = sum_i A_ji q_i' + b_j,  dw_j/dt = sum_i A_ji q_i'' + rest_j
//   Q_i = sum_j lambda_j A_ji,  A_ji = d(phi_j)/dq_i = d(w_j)/dq_i'
// The multiplier lambda_j [J over the unit of phi_j, W over that of w_j] is what the constraint's force is
// per slope: for phi = length - l the force along the length. Its power is - lambda_j b_j: none where nothing
// moves the constraint. Source: Goldstein, Classical Mechanics, 3rd ed., 2.4; Bloch, Nonholonomic Mechanics
// and Control, 2nd ed., 1.3 (the Lagrange-d'Alembert principle for the second kind).

#include <optional>
#include <vector>

#include "core/mechanics/parsed_scene.hpp"

namespace qdot {

struct ConstraintEquation {
  std::optional<Expression> position;  ///< phi; none of a constraint in the velocities
  Expression rate;                     ///< w
  std::vector<Expression> slope;       ///< A_ji in order of the coordinates
  Expression rest;                     ///< dw/dt without accelerations
};

/// d(phi)/dx, or d(w)/dx' of a constraint in the velocities.
[[nodiscard]] Expression slope_of(const ParsedConstraint& constraint, const Expression& x,
                                  const Expression& rate);

/// In order, with `holding` put in.
[[nodiscard]] std::vector<ConstraintEquation> constraint_equations(const ParsedScene& scene,
                                                                   std::span<const Replacement> holding);

/// Coordinates that a constraint holds where parameters say, r - R - a = 0, by that; their rates, zero.
[[nodiscard]] std::vector<Replacement> held_by_constraints(const std::vector<ConstraintEquation>& constraints,
                                                           const Symbols& symbols);

/// Whether nothing moves the constraint, so that its force does no work: b = 0.
[[nodiscard]] bool is_workless(const ConstraintEquation& constraint, const Symbols& symbols);

struct RedundantConstraint {
  std::size_t constraint{};
  std::optional<std::size_t> repeats{};  ///< the one that it repeats or contradicts; none: several together
};

/// The first whose slopes depend on those before it, in every state.
[[nodiscard]] std::optional<RedundantConstraint> redundant_constraint(
    const std::vector<ConstraintEquation>& constraints);

}  // namespace qdot
