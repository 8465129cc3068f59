#pragma once
// How long one coordinate takes from one turning point a to the other, b, and back; or for one turn:
//
//   T = 2 integral_a^b dx / sqrt(2 F(x)/A(x)),     T = integral_x0^{x0 + 2 pi} dx / sqrt(2 F(x)/A(x)).
//
// The way is cut into pieces, on each of which the integral is enclosed by Taylor polynomials of U and A with
// a proven remainder (core/numerics/root_quadrature.hpp); pieces whose remainder is too large are cut again.
// Next to a turning point a the root of F is taken out: F(a + s) = s G(s), G_k = -U_{k+1}(a), so that nothing
// cancels and the singularity is integrated exactly. A kink of U ends up in a piece too short to matter. So
// the stated error holds whatever U does between two places; where the pieces allowed do not suffice it is
// large, or there is no period.
// Source: Corliss, Rall, Adaptive, self-validating numerical quadrature, SIAM J. Sci. Stat. Comput. 8 (1987).

#include "core/numerics/finding.hpp"
#include "core/turning/energy_balance.hpp"

namespace qdot {

/// There and back between two turning points.
[[nodiscard]] Finding libration_period(EnergyBalance& energy, const Interval& a, const Interval& b);

/// Where a motion turns: a zero of F, or a wall that gives back all of its speed.
struct ElasticEnd {
  Ball place;
  bool is_wall{};
};

/// There and back between two ends, one of which is a wall.
[[nodiscard]] Finding elastic_period(EnergyBalance& energy, const ElasticEnd& a, const ElasticEnd& b);

/// One turn of an angle, 2 pi being a period of U.
[[nodiscard]] Finding rotation_period(EnergyBalance& energy);

}  // namespace qdot
