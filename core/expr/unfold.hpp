#pragma once
// Expressions with kinks, |u_k| and sign(u_k), as smooth functions of their variables and of the sides s_k =
// +-1 on which the place is: |u_k| = s_k u_k, sign(u_k) = s_k. (u^2)^(1/2) counts as |u|. At the kink itself,
// u_k = 0, s_k is any number of [-1, 1]. Source: Filippov, Differential Equations with Discontinuous
// Righthand Sides (1988), 4.

#include <span>
#include <vector>

#include "core/expr/calculus.hpp"

namespace qdot {

/// Expressions without their kinks.
struct Unfolded {
  std::vector<Expression> smooth;
  std::vector<Expression> arguments;      ///< u_k, unfolded, too; one for all multiples c u_k, c constant
  std::vector<Expression> short_forms;    ///< of the arguments, or of multiples of them
  std::vector<Expression> sides;          ///< the symbols s_k
  std::vector<Replacement> replacements;  ///< |u_k| and sign(u_k), and what stands in their places
};
/// Of the kinks with one of the variables in them; the others stay.
[[nodiscard]] Unfolded unfolded(std::span<const Expression> expressions,
                                std::span<const Expression> variables);

/// ((x - 1)^2)^(1/2) for (x^2 - 2 x + 1)^(1/2): enclosed, it has a value at its kink, too.
[[nodiscard]] Expression with_squares_under_roots(const Expression& e, std::span<const Expression> variables);

}  // namespace qdot
