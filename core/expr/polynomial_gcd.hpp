#pragma once
// Greatest common divisors of polynomials in several symbols, up to a number: what makes quotients short.
// Source: Geddes, Czapor, Labahn, Algorithms for Computer Algebra (1992), 7.2 (primitive remainders).

#include "core/expr/polynomial.hpp"

namespace qdot {

/// Divides a and b, with whole coefficients that have no common divisor. 1 where an exponent is negative or
/// no integer. Neither is zero. Throws Error(too_large) where remainders grow beyond what is worthwhile.
[[nodiscard]] Polynomial greatest_common_divisor(const Polynomial& a, const Polynomial& b);

/// The common divisor of the coefficients of the powers of x: y + 1 of (y + 1) x^2 + (y + 1)^2. All exponents
/// are whole.
[[nodiscard]] Polynomial content_in(const Polynomial& a, NodeId x);

/// The largest number r > 0 of which all coefficients are whole multiples.
[[nodiscard]] Number content(const Polynomial& a);

/// a as outside^2 * inside, with as much outside as squares in its factors allow. The coefficients of
/// `inside` are whole.
struct SquareFactors {
  Polynomial outside, inside;
};
[[nodiscard]] SquareFactors square_factors(const Polynomial& a);

}  // namespace qdot
