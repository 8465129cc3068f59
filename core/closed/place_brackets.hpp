#pragma once
// Two forces that are linear in powers of two brackets, such as the distances from two bodies that draw a
// third one: what the brackets are, and then the place by them (the corners of an equilateral triangle with
// two stars).

#include <vector>

#include "core/closed/exact_place.hpp"

namespace qdot {

/// Equations in x without those powers, beside the forces: B_k - value, and what the two leave when a square
/// is eliminated. Empty where the forces are none like that.
[[nodiscard]] std::vector<Expression> equations_of_brackets(const std::vector<Expression>& forces,
                                                            const std::vector<Expression>& x,
                                                            const SignOf& sign);

}  // namespace qdot
