#pragma once
// Equations less multiples of others, g_i - m g_j or m_i g_i - m_j g_j, in which terms cancel that both have
// a share in: g_1 = u^3 - u and g_2 = 2 y (u^3 - u) + y, with u = x + y^2, vanish together only where g_2 - 2
// y g_1 = y does. By themselves both may be small all along u = 1. Of two forces in a plane the second may be
// the moment x g_y - y g_x, in which the central forces are gone.
//
// m is a sum of monomials by which the terms of g_i that a monomial of g_j divides are taken away one after
// the other, as in a division of polynomials (Cox, Little, O'Shea, Ideals, Varieties, and Algorithms, 4th
// ed., 2.3); m_i and m_j are the least by which a monomial of each becomes the same (ibid., 2.6). Here any
// monomial may lead, since the multiplied sums only have to be shorter. Where all m are finite, what vanishes
// with all g_i does so with these.

#include <span>
#include <vector>

#include "core/expr/expression.hpp"

namespace qdot {

/// The few that are shortest, shorter than the equation that they come from. m is finite for all finite
/// values of `variables`.
[[nodiscard]] std::vector<Expression> reduced_equations(std::span<const Expression> equations,
                                                        std::span<const Expression> variables);

}  // namespace qdot
