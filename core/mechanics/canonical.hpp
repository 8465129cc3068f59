#pragma once
// The canonical side of a Lagrangian that is quadratic in the velocities: L = q'.A q'/2 + a.q' + L0.

#include <optional>
#include <vector>

#include "core/expr/linear.hpp"
#include "core/mechanics/lagrangian.hpp"

namespace qdot {

/// The symbols of momentum_names.
[[nodiscard]] std::vector<Expression> momentum_symbols(const Lagrangian& lagrangian);

/// Lagrange's equations of first order in (q, p): A(q,t) q' = p - a(q,t), p_i' = dL/dq_i + Q_i.
struct CanonicalEquations {
  Matrix mass;  ///< A, symmetric
  /// det A in short form for two degrees of freedom.
  std::optional<Expression> determinant;
  std::vector<Expression> linear;  ///< a
  std::vector<Expression> forces;  ///< dL/dq_i + Q_i, in q, q' and t
};
/// No value for an L that is not quadratic in the velocities.
[[nodiscard]] std::optional<CanonicalEquations> canonical_equations(const Lagrangian& lagrangian);

/// H(q, p, t) = sum p_i q_i' - L with the velocities eliminated. No value where T couples more than three
/// velocities with each other, or for an L that is not quadratic in the velocities.
[[nodiscard]] std::optional<Expression> hamiltonian(const Lagrangian& lagrangian);

/// Coordinates that L and the generalized forces do not contain: dL/dq_i = 0 and Q_i = 0.
[[nodiscard]] std::vector<std::size_t> ignorable_coordinates(const Lagrangian& lagrangian);

/// Routh's function R = L - sum p_i q_i' over the ignorable coordinates, their velocities eliminated
/// (Goldstein 8.3): the Lagrangian of the other coordinates, with the p_i as constants.
struct Routhian {
  Expression routhian;
  std::vector<std::size_t> ignored;
  std::vector<Expression> rates;  ///< q_i' of the ignored coordinates in terms of p_i
};
/// No value without ignorable coordinates, or where they are all.
[[nodiscard]] std::optional<Routhian> routhian(const Lagrangian& lagrangian);

}  // namespace qdot
