#pragma once
// Squares of cosines in formulas: 1 - cos(a)^2 is sin(a)^2, which roots give up.

#include "core/expr/surd.hpp"

namespace qdot {

/// With cos^2 u -> 1 - sin^2 u under roots and around them, each a product again, and squares taken out of
/// the roots; e itself where no cosine is squared. It may be longer.
[[nodiscard]] Expression with_sine_squares(const Expression& e, const SignOf& sign);

}  // namespace qdot
