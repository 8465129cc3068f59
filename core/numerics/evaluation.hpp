#pragma once

namespace qdot {

/// How one evaluation of a function ended. `nonfinite`: a value is infinite or not a number. `singular_mass`:
/// a linear system on the way to the value has no solution; in mechanics its matrix is the mass matrix.
enum class Evaluation { ok, nonfinite, singular_mass };

}  // namespace qdot
