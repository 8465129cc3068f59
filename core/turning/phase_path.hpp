#pragma once
// A closed motion of one coordinate that the energy integral describes, as a path over its phase: one
// revolution of the phase is all of it.
//
//   libration between a and b:  x = (a + b)/2 + (b - a)/2 cos(phase),  x' = -(b - a)/2 sin(phase) sqrt(2
//   Q(x)/A(x)) rotation from x0:           x = x0 + phase,  x' = +-sqrt(2 F(x)/A(x))
// with F, A and Q of oscillation_period.hpp.

#include <functional>
#include <utility>

#include "core/turning/energy_balance.hpp"

namespace qdot {

/// phase [rad] -> (x, x').
using PhasePath = std::function<std::pair<double, double>(double phase)>;

/// `energy` must outlive the path.
[[nodiscard]] PhasePath libration_path(EnergyBalance& energy, const Interval& a, const Interval& b);
/// In the direction of x0'.
[[nodiscard]] PhasePath rotation_path(EnergyBalance& energy, double x0_dot);

}  // namespace qdot
