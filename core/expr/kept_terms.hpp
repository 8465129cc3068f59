#pragma once
// Terms that are computed as they were written. The short form of an expression multiplies it out, which is
// an identity, but costs digits: 1 + ((x - c)/w)^8 has the value 1 at x = c, and multiplied out it is a sum
// of terms (c/w)^8. So a term in which a power of a sum stands inside a function or below a bar, or has the
// exponent 3 or more, keeps its form wherever numbers are computed.

#include <vector>

#include "core/expr/expression.hpp"

namespace qdot {

/// Whether e loses digits when it is multiplied out.
[[nodiscard]] bool loses_digits_multiplied_out(const Expression& e);

/// The terms of a sum, also of one that stands behind a factor such as m/2, each with that factor.
[[nodiscard]] std::vector<Expression> summands(const Expression& e);

/// A sum in two parts: terms to be written short, and those to be kept as they are.
struct Terms {
  Expression plain;
  Expression kept;
};
[[nodiscard]] Terms split_kept_terms(const Expression& e);

/// The short form of e (core/expr/simplify.hpp), with such terms as they are.
[[nodiscard]] Expression shortened(const Expression& e);

/// The short form of e, with terms that contain abs as they are, and sign(u) times what is zero where u is as
/// an abs: multiplied out it is a difference of jumps, of which intervals do not see that it is none.
[[nodiscard]] Expression shortened_beside_kinks(const Expression& e);

/// de/dx as shortened() does: 3 (x - c)^2 of (x - c)^3, as what is kept of e is kept in its derivative.
[[nodiscard]] Expression shortened_derivative(const Expression& e, const Expression& x);

}  // namespace qdot
