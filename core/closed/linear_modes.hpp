#pragma once
// Solutions of M u'' + G u' + K u = 0 by the parameters. Of two coordinates that gyroscopic terms couple,
// lambda = omega^2 solves
//
//   (k11 - lambda m11)(k22 - lambda m22) - (k12 - lambda m12)^2 - lambda g^2 = 0,   g = g12 = -g21
//
// (Goldstein, Classical Mechanics, 5.7: the top). Damping D leaves the shapes of the undamped motion where
// each has D v = decay M v (Meirovitch, Fundamentals of Vibrations, 7.15: proportional damping).

#include <optional>
#include <vector>

#include "core/closed/linear_motions.hpp"
#include "core/expr/surd.hpp"

namespace qdot {

/// lambda and the shape, in the coordinates x; no shape of two coordinates that gyroscopic terms couple, nor
/// where lambda has cosines in it.
struct LinearMode {
  Surd lambda;
  std::vector<Surd> shape;
  std::vector<std::size_t> group;  ///< the coordinates that it moves, after they fell apart
  Surd decay;                      ///< D v = decay M v: s^2 + decay s + lambda = 0
  /// sqrt(lambda.n) as (k11 m22 - k22 m11)^2 + 4 m11 m22 k12^2 under a root, of two coordinates with m12 = 0.
  std::optional<Expression> root{};
};

/// All modes at a place, `relations` put in. Of damped coordinates those are missing whose shape damping
/// changes, and of more than two that do not fall apart (equal_parts.hpp) those of long factors of their
/// determinant (characteristic_roots.hpp).
[[nodiscard]] std::vector<LinearMode> modes_at(const LinearMotions& motions, const ExactPlace& place,
                                               std::span<const Replacement> relations);

/// sqrt(n), in its own short form or as one of the modes has it.
[[nodiscard]] Expression shortest_root(Graph& graph, std::span<const LinearMode> modes, const Polynomial& n);

}  // namespace qdot
