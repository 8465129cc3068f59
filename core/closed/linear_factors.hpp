#pragma once
// Sums with the factors x - r y taken out, r a small number, R^3 - 2 a R^2 - a^2 R + 2 a^3 as
// (R + a)(R - a)(R - 2 a), or with a square made complete: a^2 - 2 a b + b^2 + 4 c^2 as (a - b)^2 + 4 c^2.

#include "core/expr/rational_function.hpp"

namespace qdot {

/// e where it has none, or where that is no shorter.
[[nodiscard]] Expression with_linear_factors(const Expression& e);

}  // namespace qdot
