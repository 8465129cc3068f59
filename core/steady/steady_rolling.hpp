#pragma once
// Steady motions of a scene with constraints in the velocities, such as rolling, and the equations of small
// departures u from them. Coordinates that nothing depends on keep their rates; all others rest.
//
//   M u'' + D u' + K u = A^T mu,   A u' + B u = 0      mu: what the multipliers lambda change by
//   M = dE/dq'',  D = dE/dq',  K = d(E - A^T lambda)/dq,  A = dw/dq',  B = dw/dq
//   A u = 0 as well for the rows of holonomic constraints
//
// with Lagrange's equations E = A^T lambda and the constraints w(q, q') = 0. Source: Neimark, Fufaev,
// Dynamics of Nonholonomic Systems (1972).

#include <optional>
#include <vector>

#include "core/dynamics/dynamics.hpp"
#include "core/numerics/eigensystem.hpp"
#include "core/steady/solved_slopes.hpp"

namespace qdot {

struct SteadyRolling {
  std::vector<Ball> y;                        ///< (q, q')
  SquareMatrix<Ball> mass, stiffness, rates;  ///< M, K and D
  BallMatrix slope, drift;                    ///< A and B
  std::vector<bool> holonomic;                ///< by constraint
};

[[nodiscard]] bool has_constraint_in_velocities(const Model& model);

/// The motion that `initial` (q, q') has where only the coordinates that nothing depends on move; at `guess`
/// (q), where given. Throws Error(not_applicable) where that is no steady motion, where the time enters the
/// equations, and with kinks in the forces.
[[nodiscard]] SteadyRolling steady_rolling(const Dynamics& dynamics, const Reals& parameters,
                                           const Reals& initial,
                                           const std::optional<std::vector<double>>& guess);

}  // namespace qdot
