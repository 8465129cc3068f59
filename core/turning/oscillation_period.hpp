#pragma once
// How long one coordinate takes from one turning point a to the other, b, and back; or for one turn:
//
//   T = 2 integral_a^b dx / sqrt(2 F(x)/A(x)) = 2 integral_0^pi sqrt(A(x) / (2 Q(x))) dphi,
//   x = (a + b)/2 + (b - a)/2 cos(phi),  Q(x) = F(x)/((x - a)(b - x)).
//
// The integrand is smooth, even and periodic in phi, so that the trapezoidal rule converges geometrically;
// where a maximum of U comes near the motion it does so too slowly, and a double exponential rule takes over.
// Source: Trefethen, Weideman, The exponentially convergent trapezoidal rule, SIAM Review 56 (2014) 385-458;
// Takahasi, Mori, Double exponential formulas for numerical integration, Publ. RIMS 9 (1974) 721-741.

#include "core/numerics/finding.hpp"
#include "core/turning/energy_balance.hpp"

namespace qdot {

/// There and back between two turning points.
[[nodiscard]] Finding libration_period(EnergyBalance& energy, const Interval& a, const Interval& b);

/// One turn of an angle, 2 pi being a period of U.
[[nodiscard]] Finding rotation_period(EnergyBalance& energy);

}  // namespace qdot
