#pragma once
// Quotients of what grows beyond all numbers, written so that they still have a value there:
//
//   sinh^a u / cosh^b u  =  tanh^m u sinh^(a-m) u / cosh^(b-m) u                     m = min(a, b)
//   e^(a u) / S^b        =  e^((a-m) u) / (S^(b-m) (S e^-u)^m)   S a sum in which e^u is a factor of a term
//
// where a sum above is taken term by term if one of its terms is such an e^u. All are identities. In doubles
// e^u / (1 + e^u)^2 is inf/inf from u = 710 on, and the right side 0.

#include "core/expr/expression.hpp"

namespace qdot {

/// The same product, without such quotients.
[[nodiscard]] Expression without_growing_quotients(const Expression& product);

}  // namespace qdot
