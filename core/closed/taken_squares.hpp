#pragma once
// Squares under roots as they are with the signs at one place: k/sqrt((d - l)^2) is k/(l - d) where l > d.

#include "core/expr/surd.hpp"

namespace qdot {

/// Roots of quotients whose square roots are quotients, too; others stay.
[[nodiscard]] Expression with_squares_taken_out(const Expression& e, const SignOf& sign);

}  // namespace qdot
