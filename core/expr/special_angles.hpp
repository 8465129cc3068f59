#pragma once
// Sines and cosines of known angles.

#include "core/expr/expression.hpp"

namespace qdot {

/// e with the sines and cosines of multiples of pi/6 and pi/4 as numbers, and those of r pi + u by those of u
/// for multiples r of 1/2. Exact.
[[nodiscard]] Expression with_special_angles(const Expression& e);

}  // namespace qdot
