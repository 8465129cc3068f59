#pragma once
// What symmetries keep constant, with names and in words.

#include "core/mechanics/model.hpp"
#include "core/symmetry/symmetries.hpp"

namespace qdot {

struct FoundQuantities {
  std::shared_ptr<Graph> graph;  ///< of their values
  std::vector<ConservedQuantity> quantities;
  bool is_complete{true};  ///< as SymmetrySearch's
};

/// Of the symmetries that affine_symmetries() finds beside `known`. `lagrangian` is the model's, on a copy of
/// its graph, with `replacements` put in. A change that moves all bodies alike is named by what it does in
/// space (momentum_x, angular_momentum_z), others by the coordinates that they change.
[[nodiscard]] FoundQuantities found_quantities(const Model& model, const Lagrangian& lagrangian,
                                               std::span<const Replacement> replacements,
                                               std::span<const ConservedQuantity> known);

}  // namespace qdot
