#pragma once
// lambda with det(K - lambda M) = 0 for more than two coordinates, as far as the determinant is a product of
// factors of the first or second degree that are found without factoring (steady/factors.hpp): powers of
// lambda, what is there more than once, and what all coefficients of a parameter's powers have in common. A
// triangle of equal masses and springs has (3 k - lambda m)(3 k - 2 lambda m)^2 lambda^3.

#include "core/closed/equal_parts.hpp"
#include "core/expr/surd.hpp"

namespace qdot {

struct CharacteristicRoots {
  std::vector<Surd> surds;
  std::vector<Surd> by_angles;  ///< with sines or cosines of shares of a turn (cosine_roots.hpp)
};

/// Each root once, without 0.
[[nodiscard]] CharacteristicRoots characteristic_roots(Graph& graph, const LinearMatrices& matrices,
                                                       const std::vector<std::size_t>& group);

/// v with (K - lambda M) v = 0, of all coordinates; 0 outside the group. Empty where there is none.
[[nodiscard]] std::vector<Surd> null_vector(const Graph& graph, const LinearMatrices& matrices,
                                            const std::vector<std::size_t>& group, const Surd& lambda);

}  // namespace qdot
