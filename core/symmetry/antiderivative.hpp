#pragma once
// Integrals over one symbol t, where they are elementary: of sums of
//
//   t^n exp(a t + b) cos(w t + c)    products and powers of such exponentials, sines and cosines included
//   (a t + b)^n, 1/(a + b t^2) of squares a and b, and single functions of a t + b beside t^0 or t^1.
//
// With S = exp(u) sin(v), C = exp(u) cos(v) and D = a^2 + w^2:
//
//   int S = (a S - w C)/D,  int C = (a C + w S)/D,  int t^n f = t^n int f - n int (t^(n-1) int f).

#include <optional>

#include "core/expr/expression.hpp"

namespace qdot {

/// No value for other functions. What is divided by, w say, is taken not to vanish.
[[nodiscard]] std::optional<Expression> antiderivative(const Expression& g, const Expression& t);

}  // namespace qdot
