#pragma once
// What is in L and in no equation of motion: a total derivative. Of an L whose part of degree one in the
// velocities is A(q, t).q', the terms a of A and b with
//
//   da_i/dq_j = da_j/dq_i,  db/dq_i = da_i/dt
//
// are df/dt = a.q' + b of one function f(q, t), which need not be known: L - a.q' - b has the same motions,
// the same constants, and symmetries that show without a gauge of their own. Source: Goldstein, Classical
// Mechanics, 3rd ed., 1.4 and exercise 1.8.

#include "core/mechanics/lagrangian.hpp"

namespace qdot {

/// L without them: all of A where it is such a derivative; otherwise what is not linear in the coordinates,
/// as beside a uniform magnetic field; otherwise those terms that have to do with their own coordinate and
/// the time alone. b is found where a has degrees in the coordinates, and where L has it in terms of its own.
/// Else, and where L is not quadratic in the velocities, L as it is.
[[nodiscard]] Expression without_gauge_terms(const Lagrangian& lagrangian);

}  // namespace qdot
