#pragma once
// Where oscillations about equilibria begin to grow (core/steady/growing_oscillations.hpp), as functions of
// the equilibria's coordinates and of all constants.

#include <optional>
#include <vector>

#include "core/expr/calculus.hpp"
#include "core/steady/steady_forces.hpp"

namespace qdot {

struct GrowthCondition {
  std::optional<Expression> condition;  ///< vanishes where they begin to; none where they never do
  std::optional<Expression> square;     ///< of their frequency
  bool is_collision{};                  ///< of two frequencies
  bool is_unknown{};                    ///< too many coordinates, or algebra that grows too large
};

/// In the given graph. `x`: all coordinates that are left; `linear`: those that follow from others.
[[nodiscard]] GrowthCondition derive_growth_condition(const Reduction& reduction, const SteadyForces& forces,
                                                      Graph& graph, const std::vector<Expression>& x,
                                                      std::span<const Replacement> linear);

}  // namespace qdot
