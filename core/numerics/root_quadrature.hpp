#pragma once
// Integrals of sqrt(p/q) with a proven remainder, p and q being Taylor polynomials whose last coefficient is
// an enclosure over the whole piece (taylor_enclosure.hpp), scaled so that the variable t keeps to [-1, 1].
//
// With any polynomial g near sqrt(p/q) the defect D = p - q g^2 is a polynomial, too, and
//
//   |sqrt(p/q) - g| = |D| / (q (sqrt(p/q) + g)) <= sum |D_k| / (min q (min sqrt(p/q) + min g)),
//
// so that only D is enclosed and g itself may be rounded as it likes. The part of D below the order n is
// rounding, the other one truncation, which a shorter piece makes smaller. Rounding is that of numbers with
// twice the digits of doubles.

#include <span>

#include "core/numerics/ball.hpp"

namespace qdot {

/// A function of t: its coefficients, all but the last thin, and its range as far as that is known better
/// than the coefficients tell.
struct EnclosedPolynomial {
  std::span<const Ball> coefficients;
  Interval range = Interval::whole();
};

struct EnclosedIntegral {
  Ball value{DoubleDouble{}, std::numeric_limits<double>::infinity()};
  double truncation{};  ///< what a shorter piece would take off the width of `value`
};

/// Of sqrt(p/q) from `from` to `to`, in [-1, 1]. As many coefficients of p as of q.
[[nodiscard]] EnclosedIntegral integral_of_root(const EnclosedPolynomial& p, const EnclosedPolynomial& q,
                                                const Ball& from, const Ball& to);

}  // namespace qdot
