#pragma once
// Equations with exponentials, for intervals that reach far out. Of
//
//   f = c_0 + c_1 w + ... + c_n w^n,   w = exp(y) > 0,
//
// sums such as w - w^2 have no sign where w overflows, though f is not 0 there; nested, c_0 + w (c_1 + w
// (...)), they have, and c_0 is left where w is tiny. So are sinh, cosh and tanh of whole multiples of y,
// times a power of w.

#include <optional>
#include <span>

#include "core/expr/expression.hpp"
#include "core/expr/polynomial.hpp"

namespace qdot {

enum class Exponential { rising, falling };  ///< w = exp(y), or exp(-y)

/// e as a polynomial in the symbol w, times a power of it.
struct ByExponential {
  Polynomial e;
  Expression w, argument;  ///< w = exp(argument)
};

/// No value where no exponentials of one y are in it.
[[nodiscard]] std::optional<ByExponential> by_exponential(const Expression& e,
                                                          std::span<const Expression> variables,
                                                          Exponential w = Exponential::rising);

/// An equation with the same zeros, nested in w; e itself where no exponentials of one y are in it.
[[nodiscard]] Expression nested_in_exponentials(const Expression& e, std::span<const Expression> variables,
                                                Exponential w = Exponential::rising);

}  // namespace qdot
