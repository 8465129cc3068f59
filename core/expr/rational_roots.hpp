#pragma once
// Rational roots of polynomials in one unknown, exactly.

#include <span>
#include <vector>

#include "core/expr/number.hpp"

namespace qdot {

/// The simple ones of c_0 + c_1 x + ... + c_n x^n, c_n != 0, ascending. A root beside another one that
/// doubles do not tell from it may be missing.
[[nodiscard]] std::vector<Number> rational_roots(std::span<const Number> c);

}  // namespace qdot
