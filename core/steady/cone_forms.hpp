#pragma once
// What decides about a cone of the forces (core/steady/cones.hpp), written as functions.

#include <span>
#include <vector>

#include "core/compile/compiled_function.hpp"
#include "core/expr/expression.hpp"

namespace qdot {

/// Functions of the reduction's constants, and of x and r.
struct ConeForms {
  CompiledFunction place;   ///< p_j, then a_j
  CompiledFunction slopes;  ///< C by rows, then f
  bool is_pole{};           ///< forces grow without bound towards it
};

/// Of those `equations` of which there are as many as `unknowns`, in one graph; `x`: all coordinates. Cones
/// that are lines, as where a distance does not depend on all unknowns, are left out.
[[nodiscard]] std::vector<ConeForms> derive_cones(std::span<const Expression> constants,
                                                  std::span<const Expression> x,
                                                  std::span<const Expression> unknowns,
                                                  std::span<const Expression> equations);

}  // namespace qdot
