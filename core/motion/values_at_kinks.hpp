#pragma once
// Values of columns at one state, which may be on a kink of the equations: the accelerations of a block that
// sticks are zero there.

#include "core/dynamics/dynamics.hpp"

namespace qdot {

struct StatedValues {
  std::vector<double> values;
  /// How far each is from its true value at most, for the parameters and the state as the real numbers that
  /// they are; infinite where no bound was found.
  std::vector<double> errors;
};

/// As values_at(), with the accelerations with which the motion goes on. Throws Error(invalid_state) also
/// where the equations do not tell how it does.
[[nodiscard]] StatedValues values_at_kinks(const Dynamics& dynamics, const std::vector<Column>& columns,
                                           const Reals& parameters, double t, const Reals& y);

}  // namespace qdot
