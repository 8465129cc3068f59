#pragma once
// What an impact does to the velocities, derived. It takes no time, so positions stay, and only impulses
// count:
//
//   M (v+ - v-) = sum of impulses J_k^T Lambda_k,   M = d2T/dq'2
//
// With restitution e, along the gradient a = dphi/dq of the distance phi (no friction):
//
//   v+ = v- - (1 + e) (a.v- + phi_t) / (a.M^-1 a) M^-1 a,   so that phi'+ = -e phi'-
//
// Where constraints A q' + b = 0 hold, they push too, and what they keep stays kept:
//
//   M (v+ - v-) = a Lambda + A^T nu,   A (v+ - v-) = 0,
//
// so that M^-1 a stands for the w with M w = a + A^T nu, A w = 0.
//
// With a contact that is made at the point s while the one at the point p, which rested, is left without a
// push: after it s rests, and p may go. In the frame of s the impulse does no work on any velocity, so the
// momenta
//
//   P_j = sum of m V.d(V - V_s)/dq_j' + sum of I w dw/dq_j'
//
// of the velocities before are those of the velocities after, which follow from
// d2/dq'2 [sum of m (V - V_s)^2/2 + sum of I w^2/2]. With point feet: angular momentum is kept about the new
// contact, and of each further link about its joint. Sources: Goldstein, Classical Mechanics, 3rd ed., 2.7
// and problem 2.22 (impulsive motion); Garcia, Chatterjee, Ruina and Coleman, The simplest walking model,
// 1998, 2.

#include <vector>

#include "core/mechanics/lagrangian.hpp"

namespace qdot {

/// The state after an impact of the scene that has a contact, as functions of the one before. Throws
/// Error(not_applicable) where the velocities are not determined.
[[nodiscard]] std::vector<Replacement> derived_impact(const ParsedScene& scene, const ParsedContact& contact,
                                                      const Lagrangian& lagrangian);

}  // namespace qdot
