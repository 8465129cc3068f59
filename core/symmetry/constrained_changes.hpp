#pragma once
// Changes of a motion that constraints A q' + b = 0 single out, beside those that are affine in the
// coordinates (point_change.hpp):
//
//   along the constraints   xi = det(A_D) e_f - e_D adj(A_D) A_f,  so that A xi = 0: f is a coordinate beside
//                           as many dependent ones D as there are constraints
//   a turn of one body      omega(xi) = e, the other coordinates stay: about an axis e of space, or of the
//   body
//
// The first are the symmetries of what rolls or slides on an edge: a knife's edge keeps its speed though
// neither x nor y is ignorable. Of the second is the spin of a ball that rolls. What they keep is constant on
// the constraints alone, where q_D' = -A_D^-1 (A_F q_F' + b) stands for the rates of D. Source: Bloch,
// Nonholonomic Mechanics and Control, 2nd ed., 5.5 (horizontal symmetries and the momentum equation).

#include <optional>

#include "core/expr/linear.hpp"
#include "core/mechanics/parsed_scene.hpp"
#include "core/symmetry/point_change.hpp"

namespace qdot {

struct AllowedRates {
  std::vector<std::size_t> dependent;  ///< D
  Matrix slopes;                       ///< A_D
  Expression determinant;              ///< of A_D
  std::vector<Replacement> rates;      ///< q_D' by the others
};

/// None without constraints, with too many to be solved in writing, and where they depend on each other.
[[nodiscard]] std::optional<AllowedRates> allowed_rates(const Lagrangian& lagrangian);

/// Along the constraints, where one of them is in the velocities.
[[nodiscard]] std::vector<ElementaryChange> changes_along(const Lagrangian& lagrangian,
                                                          const AllowedRates& allowed);

/// Of the bodies in space that three coordinates turn, without those that are shifts of a coordinate. With
/// `replacements` put into what the scene says, whose graph the Lagrangian's is a copy of.
[[nodiscard]] std::vector<ElementaryChange> turns_of_bodies(const ParsedScene& scene,
                                                            const Lagrangian& lagrangian,
                                                            std::span<const Replacement> replacements);

}  // namespace qdot
