#pragma once
// Symmetries of a Lagrangian that are affine in the coordinates, searched for and proved: see
// point_change.hpp for what one is and what it keeps constant. xi_i = sum A_ij q_j + b_i + c_i t, tau is a
// constant and F has degree two at most in q and t: translations, rotations of several coordinates at once,
// screw motions, uniform motions (Galilei), and all of these together with a shift of the time.
//
// Of scenes with constraints also those of constrained_changes.hpp, and R has to vanish on the constraints
// alone.
//
// They are proposed by linear dependences among the changes of L at random places, in exact arithmetic
// (random_place.hpp), with coefficients in the parameters (exact_coefficients.hpp), for all of whose values a
// symmetry holds; and claimed where the algebra shows that R = 0 identically (core/expr/zeroness.hpp).

#include <functional>

#include "core/mechanics/conserved.hpp"
#include "core/symmetry/point_change.hpp"

namespace qdot {

/// coefficients[k] belongs to the search's changes[k].
struct Symmetry {
  std::vector<Expression> coefficients;
  PointChange change;
};

struct SymmetrySearch {
  /// A copy, whose graph all expressions here belong to; without total derivatives (gauge_terms.hpp).
  Lagrangian lagrangian;
  std::vector<ElementaryChange> changes;
  std::vector<Symmetry> found;
  /// Rates by others, as the constraints give them.
  std::vector<Replacement> on_constraints;
  /// False where the scene is too large to be searched, or a dependence that shows at places was not proved.
  bool is_complete{true};
};

/// More changes that a search may combine, of its own copy of the Lagrangian.
using MoreChanges = std::function<std::vector<ElementaryChange>(const Lagrangian& own)>;

/// Those that are not among `known`, which conserved_quantities() found: ignorable coordinates and the time.
[[nodiscard]] SymmetrySearch affine_symmetries(const Lagrangian& lagrangian,
                                               std::span<const ConservedQuantity> known,
                                               const MoreChanges& more = nullptr);

/// Those of an L without velocities and time that shift places alone, xi = A q + b: of a potential.
[[nodiscard]] SymmetrySearch symmetries_of_places(const Lagrangian& lagrangian);

}  // namespace qdot
