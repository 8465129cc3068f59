#pragma once
// Divided differences of the functions on a tape: f at two places a and b, and
//
//   f[a, b] = (f(b) - f(a)) / (b - a),
//
// enclosed without the cancellation of f(b) - f(a), so that the change (b - a) f[a, b] is known to a few
// roundings of itself however near the places are. Where they meet, f[a, a] = f'(a). From
//
//   (u v)[a, b] = u[a, b] v(b) + u(a) v[a, b],     (sin u)[a, b] = cos((u(a) + u(b))/2) sinc(d/2) u[a, b],
//
// d = u(b) - u(a), sinc x = sin(x)/x, and such identities for the other functions. Places may be intervals
// too: the result then holds for every pair of places in them.
// Source: R. Krawczyk, A. Neumaier, Interval slopes for rational functions and associated centered forms,
// SIAM J. Numer. Anal. 22 (1985) 604-616; W. Kahan, R. J. Fateman, Symbolic computation of divided
// differences, SIGSAM Bulletin 33 (1999) 7-28.

#include "core/numerics/interval.hpp"

namespace qdot {

struct DividedDifference {
  Interval at_a, at_b;
  Interval slope;  ///< f[a, b]

  [[nodiscard]] static DividedDifference literal(const Real& value);
  /// What does not depend on the place.
  [[nodiscard]] static DividedDifference constant(const Interval& value) { return {value, value, 0}; }
  /// Of which nothing is known.
  [[nodiscard]] static DividedDifference undefined() {
    return {Interval::whole(), Interval::whole(), Interval::whole()};
  }
  /// The place itself.
  [[nodiscard]] static DividedDifference variable(const Interval& a, const Interval& b) { return {a, b, 1}; }
};

[[nodiscard]] DividedDifference operator+(const DividedDifference& u, const DividedDifference& v);
[[nodiscard]] DividedDifference operator*(const DividedDifference& u, const DividedDifference& v);
[[nodiscard]] DividedDifference operator/(const DividedDifference& u, const DividedDifference& v);
[[nodiscard]] DividedDifference square(const DividedDifference& u);
[[nodiscard]] DividedDifference sqrt(const DividedDifference& u);
[[nodiscard]] DividedDifference sin(const DividedDifference& u);
[[nodiscard]] DividedDifference cos(const DividedDifference& u);
/// u^exponent for u >= 0 or a whole exponent, which is constant.
[[nodiscard]] DividedDifference power(const DividedDifference& u, const DividedDifference& exponent);
[[nodiscard]] DividedDifference evaluate(Function function, const DividedDifference& u);

}  // namespace qdot
