#pragma once
// Friction against a reaction of either sign, -mu |N| sign(v), as of a bead on a wire. Motions take forces
// that are linear in the multipliers lambda of constraints, which |lambda_j| is not. But where none of these
// forces changes lambda_j, it is a function of the state, by the equations of motion with any number s in the
// place of its sign:
//
//   F = a + b s lambda_j,  dlambda_j/ds = 0,   so   F = a + b |lambda_j(q, q', t)|
//
// Where friction changes what it rubs against, no such function is one of the state alone. Source: Pfeiffer
// and Glocker, Multibody Dynamics with Unilateral Contacts, 1996, 5.

#include "core/mechanics/parsed_scene.hpp"

namespace qdot {

/// Whether a component of a force is linear in multipliers and in their sizes.
[[nodiscard]] bool is_linear_in_reactions(const Expression& component,
                                          const std::vector<Expression>& multipliers);

/// Puts functions of the state into forces that contain |lambda_j|. Throws SceneError where friction changes
/// lambda_j, or where its function is too long to be written.
void write_sizes_of_reactions(const Scene& scene, ParsedScene& parsed);

}  // namespace qdot
