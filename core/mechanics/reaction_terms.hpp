#pragma once
// Components of forces that contain multipliers lambda of constraints, and their sizes |lambda|, whose sides
// are s (core/expr/unfold.hpp).
//
//   F = a + sum of b_k s_k lambda_k,   a linear in the multipliers, b without them

#include "core/expr/unfold.hpp"

namespace qdot {

struct ReactionTerms {
  Expression without;          ///< a
  std::vector<Expression> of;  ///< b_k
  bool is_linear{};            ///< F is of that form
};

/// Of a component that is `smooth` as `unfolded` has it.
[[nodiscard]] ReactionTerms reaction_terms(const Expression& smooth, const Unfolded& unfolded,
                                           const std::vector<Expression>& multipliers);

[[nodiscard]] bool is_linear_in_reactions(const Expression& component,
                                          const std::vector<Expression>& multipliers);

}  // namespace qdot
