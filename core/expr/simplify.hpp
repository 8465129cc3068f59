#pragma once
// Short forms of expressions, as one writes them by hand.

#include "core/expr/expression.hpp"

namespace qdot {

/// e in a short form. It is multiplied out; sin^2 + cos^2 = 1, the addition theorems and the double angle are
/// used where they shorten it; then common factors and squares are taken out. Exact, with one assumption:
/// factors cancel (x/x = 1), so the result may be regular where e was 0/0.
[[nodiscard]] Expression simplify(const Expression& e);

/// numerator / denominator, each in short form, without the factors they share. Throws
/// Error(not_applicable) when the denominator vanishes identically.
[[nodiscard]] Expression simplify_quotient(const Expression& numerator, const Expression& denominator);

}  // namespace qdot
