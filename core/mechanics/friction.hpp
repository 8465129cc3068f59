#pragma once
// Forces that contain the multipliers of constraints, such as dry friction -mu N sign(v) with the normal
// force N of the constraint that keeps a body on its plane. They are linear in the multipliers, so that
//
//   M q'' = f + C lambda,   C = A^T + (what friction adds to it)
//
// stays a linear system. Source: Pfeiffer and Glocker, Multibody Dynamics with Unilateral Contacts, 1996, 5.

#include "core/mechanics/lagrangian.hpp"

namespace qdot {

/// Q_i without the forces lambda_j A_ji of the constraints that do no work.
[[nodiscard]] std::vector<Expression> working_forces(const Lagrangian& lagrangian);

/// Whether a multiplier stands in a force beside its constraint's own.
[[nodiscard]] bool has_forces_of_multipliers(const Lagrangian& lagrangian);

}  // namespace qdot
