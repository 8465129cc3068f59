#pragma once
// Sums of fractions whose denominators are powers of one bracket, as one: v^2/(1 - v^2) + 1 = 1/(1 - v^2),
// and 1/(1 - v^2) - v^2/(1 - v^2) = 1.

#include "core/expr/polynomial.hpp"

namespace qdot {

/// For each bracket that stands below or under a root in different powers, the polynomial with the lowest of
/// them taken out of these terms, where they are no more then. Exact, except where the bracket is zero.
[[nodiscard]] std::vector<Polynomial> over_common_denominators(Graph& graph, const Polynomial& polynomial);

}  // namespace qdot
