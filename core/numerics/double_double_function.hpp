#pragma once
// Elementary functions of numbers with twice the digits of doubles.
//
// Each is within 2e-31 of its value, relative, also next to its zeros; x^c within 2e-31 (1 + |c log x|). The
// bits are the same on every processor: only sums and products of doubles are used, and SLEEF's functions for
// first approximations. (Debian's libqd starts from the logarithm and the arc tangent of libm, whose bits
// change with the processor, and has sin(750 pi) right to 14 digits.)
//
// An argument is first brought near 0 by multiples of pi/16 or ln(2)/32, of which tables hold the functions
// (Tang, Table-driven implementation of the exponential function, ACM TOMS 15 (1989) 144); the multiples are
// subtracted exactly. log and the arcs are one Newton step from the double's.

#include "core/numerics/double_double.hpp"
#include "core/numerics/function.hpp"

namespace qdot {

/// Sine and cosine are known of smaller angles only: a larger one has no value (not a number).
inline constexpr double largest_angle = 1e14;

struct SineCosine {
  DoubleDouble sine, cosine;
};
[[nodiscard]] SineCosine sine_cosine(const DoubleDouble& x);

[[nodiscard]] DoubleDouble exp(const DoubleDouble& x);
/// x^c; not a number for x < 0 unless c is whole.
[[nodiscard]] DoubleDouble power(const DoubleDouble& x, const DoubleDouble& c);
/// Any of the functions that an expression may call.
[[nodiscard]] DoubleDouble evaluate(Function function, const DoubleDouble& x);

/// pi to 106 bits.
inline constexpr DoubleDouble pi_double_double{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

}  // namespace qdot
