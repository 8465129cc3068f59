#pragma once
// Equations of one place, made simpler before they are solved: what never vanishes taken out, equal powers of
// two lengths made equal lengths, a logarithm made the exponential of its value.
//
//   p A^m + q B^m = 0   gives   A/B = +-(-q/p)^(1/m),   as of a charge between two others
//   p log(u) + q = 0    gives   u = exp(-q/p)

#include <optional>

#include "core/closed/exact_place.hpp"

namespace qdot {

/// Without factors that all terms share and that vanish nowhere: exp(..), cosh(..).
[[nodiscard]] Polynomial without_lasting_factors(const Graph& graph, const Polynomial& e);

/// Linear in x_k, where the force consists of equal powers of two linear functions of it, or of one and a
/// constant; the one of the signs that holds at the place.
[[nodiscard]] std::optional<Expression> balance_of_powers(const PlaceProblem& problem, std::size_t k,
                                                          const Expression& force);

/// u(x) - exp(value), where e = 0 gives the value of log(u(x)), and x stands in nothing else.
[[nodiscard]] std::optional<Expression> without_logarithm(Graph& graph, const Polynomial& e,
                                                          const Expression& x);

}  // namespace qdot
