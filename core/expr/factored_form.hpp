#pragma once
// Multiplied-out expressions written short again, with common factors in front of brackets.

#include <span>

#include "core/expr/polynomial.hpp"

namespace qdot {

/// An expression equal to the polynomial with few operations: common factors and squares taken out, the rest
/// grouped by the factor that most terms share, a bracket that divides the rest shared with it. A factor in
/// front of terms whose coefficients are not whole multiples of one is taken out only where that spares three
/// factors, as textbooks do: 1/2 m W^2 q^2 + 3/4 m r^2 W^2 stays, -3/2 m g l cos a - m g l cos b does not.
/// The graph remembers its brackets (bracket_memory.hpp), so that each is grouped once.
[[nodiscard]] Expression factored_form(Graph& graph, const Polynomial& polynomial);

/// The same, as a sum over the monomials in `symbols` with a factored coefficient each: the kinetic energy by
/// its velocities. A factor that all the coefficients share is taken out in front.
[[nodiscard]] Expression collected_form(Graph& graph, const Polynomial& polynomial,
                                        std::span<const Expression> symbols);

}  // namespace qdot
