#pragma once
// The steppers that SUNDIALS 6.4.1 drives. Users go through make_stepper() in methods.hpp.

#include <memory>

#include "core/integrate/stepper.hpp"

namespace qdot {

/// CVODE, Adams-Moulton of order 1 to 12, corrector by fixed-point iteration: no Jacobian.
[[nodiscard]] std::unique_ptr<Stepper> make_adams_stepper(const RightHandSide& system,
                                                          const RunRequest& request);

/// CVODE, backward differentiation of order 1 to 5,
/// corrector by Newton iteration with the dense df/dy: stiff systems.
[[nodiscard]] std::unique_ptr<Stepper> make_bdf_stepper(const RightHandSide& system,
                                                        const RunRequest& request);

/// ARKODE, explicit Runge-Kutta of order 8 (prince_dormand.hpp).
[[nodiscard]] std::unique_ptr<Stepper> make_erk_stepper(const RightHandSide& system,
                                                        const RunRequest& request);

}  // namespace qdot
