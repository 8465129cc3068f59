#pragma once
// Whether an expression is the same after a full turn of an angle.

#include "core/expr/expression.hpp"

namespace qdot {

/// Whether e has the same value at x and at x + 2 pi, as its form shows: x stands only in sines, cosines and
/// tangents of k x + c with a whole number k, or with half of one where signs that a turn changes, as that of
/// sin(x/2), come in pairs. Says no where it cannot see that. Makes no expressions, so that
/// threads may ask it of a graph that they share.
[[nodiscard]] bool has_full_turn(const Expression& e, const Expression& x);

}  // namespace qdot
