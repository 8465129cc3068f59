#pragma once
// Roots of products of symbols, taken for each symbol, so that what they share goes:
// (k1 - sqrt(k1*k2))/(k1 - k2) is sqrt(k1)/(sqrt(k1) + sqrt(k2)).

#include "core/expr/surd.hpp"

namespace qdot {

/// The same where it is shorter; the symbols under the roots are positive.
[[nodiscard]] Expression with_split_roots(const Expression& e, const SignOf& sign);

}  // namespace qdot
