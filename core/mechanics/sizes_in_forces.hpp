#pragma once
// Components of forces that contain sizes |lambda_j| of the multipliers of constraints.

#include <vector>

#include "core/expr/unfold.hpp"

namespace qdot {

/// c = a + sum of b_k s_k lambda_k.
struct SizesInForce {
  Expression without;          ///< a
  std::vector<Expression> of;  ///< b_k
  bool is_linear{};            ///< in the multipliers, too
};

/// Of a component `smooth` in which `unfolded` has put lambda_k s_k for each size.
[[nodiscard]] SizesInForce sizes_in(const Expression& smooth, const Unfolded& unfolded,
                                    const std::vector<Expression>& multipliers);

/// Whether a component of a force is linear in multipliers and in their sizes.
[[nodiscard]] bool is_linear_in_reactions(const Expression& component,
                                          const std::vector<Expression>& multipliers);

}  // namespace qdot
