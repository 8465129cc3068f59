#pragma once
// Values of columns at one state, which may be on a kink of the equations: the accelerations of a block that
// sticks are zero there.

#include "core/dynamics/dynamics.hpp"

namespace qdot {

/// As values_at(), with the accelerations with which the motion goes on. Throws Error(invalid_state) also
/// where the equations do not tell how it does.
[[nodiscard]] std::vector<double> values_at_kinks(const Dynamics& dynamics,
                                                  const std::vector<Column>& columns,
                                                  std::span<const double> parameters, double t,
                                                  std::span<const double> y);

}  // namespace qdot
