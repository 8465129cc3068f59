#pragma once
// Equations less multiples of others, g_i - m g_j, in which terms cancel that both have a share in:
// g_1 = u^3 - u and g_2 = 2 y (u^3 - u) + y, with u = x + y^2, vanish together only where g_2 - 2 y g_1 = y
// does. By themselves both may be small all along u = 1.
//
// m is a sum of monomials by which the terms of g_i that a monomial of g_j divides are taken away one after
// the other, as in a division of polynomials (Cox, Little, O'Shea, Ideals, Varieties, and Algorithms, 4th
// ed., 2.3); here any monomial of g_j may lead, since the multiplied sums only have to be shorter. Where m is
// finite, what vanishes with all g_i does so with these.

#include <span>
#include <vector>

#include "core/expr/expression.hpp"

namespace qdot {

/// The few that are shortest, shorter than the equation that they come from. m is finite for all finite
/// values of `variables`.
[[nodiscard]] std::vector<Expression> reduced_equations(std::span<const Expression> equations,
                                                        std::span<const Expression> variables);

}  // namespace qdot
