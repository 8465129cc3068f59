#pragma once
// Where a family f(x, p) = 0 of one unknown folds: df/dx = 0 beside it, or what knows nothing of p.

#include <optional>
#include <span>

#include "core/expr/expression.hpp"

namespace qdot {

/// Of f = a + p^n b: a db/dx - b da/dx = b df/dx - b' f up to its sign, so that a search far out, where
/// forces are small, does not depend on how small p is. No value where f is of another form, or where a and b
/// may vanish together, so that f does for every p. `variables`: those of numerator_of.
[[nodiscard]] std::optional<Expression> fold_without_parameter(const Expression& f, const Expression& x,
                                                               const Expression& p,
                                                               std::span<const Expression> variables);

}  // namespace qdot
