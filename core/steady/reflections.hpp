#pragma once
// Reflections of unknowns that turn what has to vanish into itself or its negative, whatever the parameter
// is: equilibria on their mirrors meet others in pairs.

#include <span>
#include <vector>

#include "core/expr/expression.hpp"

namespace qdot {

/// c of each x -> 2 c - x that turns N into -N, of the middles that `factors` of N and its derivatives
/// suggest. `variables`: x and the parameter, with which c may move.
[[nodiscard]] std::vector<Expression> centres_of_reflection(const Expression& numerator,
                                                            std::span<const Expression> factors,
                                                            std::span<const Expression> variables);

struct Mirror {
  std::vector<std::size_t> turned;  ///< unknowns whose signs change together without changing what vanishes
  std::vector<std::size_t> even;    ///< numerators that stay the same; the others change their signs
};

/// Of at most three unknowns.
[[nodiscard]] std::vector<Mirror> mirrors_of(std::span<const Expression> numerators,
                                             std::span<const Expression> x);

}  // namespace qdot
