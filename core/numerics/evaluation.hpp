#pragma once
// How one evaluation of a function ended. It is a value and no exception, because a step of an integration
// that meets such a place is tried again with a shorter length.

namespace qdot {

/// `nonfinite`: a value is infinite or not a number. `singular_mass`: a linear system on the way to the value
/// has no solution; in mechanics its matrix is the mass matrix.
enum class Evaluation { ok, nonfinite, singular_mass };

}  // namespace qdot
