#pragma once
// Curves f = 0 that fold where they meet a curve x = c(p), as x^2 + x^3 = p does at x = 0: by algebra, since
// no numbers tell that three functions of x and p vanish at one place.

#include <optional>
#include <span>

#include "core/expr/expression.hpp"

namespace qdot {

/// With f(c(p), p) = g h and df/dx (c(p), p) = g k: h, so that where the two meet and h is not 0, f folds.
/// None where `curve` is not linear in x, the first of the variables, or where f folds nowhere on it.
[[nodiscard]] std::optional<Expression> no_fold_on_curve(const Expression& curve, const Expression& f,
                                                         std::span<const Expression> variables);

/// Whether e, a function of them, has no denominators and no roots.
[[nodiscard]] bool has_value_everywhere(const Expression& e, std::span<const Expression> variables);

/// The zero c of a function that is linear in x, where c has a value for every p.
[[nodiscard]] std::optional<Expression> curve_of_line(const Expression& f,
                                                      std::span<const Expression> variables);

}  // namespace qdot
