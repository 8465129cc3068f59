#pragma once
// Lagrange's equations d/dt dL/dq_i' - dL/dq_i = Q_i, linear in the accelerations: M(q,t) q'' = f(q,q',t).
//
// Each equation is divided by the factor that all its terms share, as one does by hand: m l^2 in the equation
// of a leg whose foot has the mass m, which stays regular when the foot loses its mass. Dividing assumes the
// factor is not zero; where it can be (a coordinate, a bracket such as 1/2 + sin(theta)), the equation says
// the same everywhere else. The rows of M are divided each by its own factor, so M is not symmetric.

#include <optional>
#include <vector>

#include "core/expr/linear.hpp"
#include "core/mechanics/lagrangian.hpp"

namespace qdot {

/// left = right: what comes of L on the left, what is not in L on the right.
struct Equation {
  Expression left, right;
  Expression divided_by;  ///< the common factor taken out
};

struct EquationsOfMotion {
  std::vector<Equation> equations;  ///< in order of the coordinates
  Matrix mass_matrix;               ///< M, n x n, rows divided
  std::vector<Expression> forcing;  ///< f
  Matrix reactions;                 ///< C, n x m: M q'' = f + C lambda; rows empty without constraints
  /// det M in short form for n = 2: 1 + mu sin^2(phi) without the cancellation of M11 M22 - M12 M21.
  std::optional<Expression> determinant;
};

[[nodiscard]] EquationsOfMotion derive_equations(const Lagrangian& lagrangian);

/// M_ij = d2L/dq_i'dq_j' as it is, symmetric, undivided.
[[nodiscard]] Matrix mass_matrix(const Lagrangian& lagrangian);

/// The equations with those of the constraints, linear in the accelerations and the multipliers.
struct AugmentedSystem {
  Matrix matrix;                     ///< [M, -C; A, 0]
  std::vector<Expression> right;     ///< f, then -rest
  std::vector<Expression> unknowns;  ///< q'', then lambda
};
[[nodiscard]] AugmentedSystem augmented(const EquationsOfMotion& equations, const Lagrangian& lagrangian);

/// q'', then lambda, written out; empty where that is too long to be read. May throw Error(too_large).
[[nodiscard]] std::vector<Expression> solved(const AugmentedSystem& system);

/// The same on the constraints: with what they hold put in, where that is shorter.
[[nodiscard]] std::vector<Expression> solved_on_constraints(const AugmentedSystem& system,
                                                            const Lagrangian& lagrangian);

}  // namespace qdot
