#pragma once
// Orientations of a body as turns one after the other, and the angular velocity that follows from them.
//
// Turn k is by the angle alpha_k about the unit vector n_k, which the turns before it have carried along:
//
//   R = R_1 R_2 ... R_n,   R_k v = n (n.v) + cos(alpha) (v - n (n.v)) + sin(alpha) n x v   (Rodrigues)
//   omega = sum of alpha_k' R_1 ... R_(k-1) n_k            in the axes of space
//   Omega = R^T omega = sum of alpha_k' R_n^T ... R_(k+1)^T n_k   in the axes of the body
//
// Source: Goldstein, Classical Mechanics, 3rd ed., 4.4 (Euler angles: Z X Z), 4.7 and 4.9 (Rodrigues'
// formula, angular velocities add); Diebel, Representing Attitude, 2006, 5.6 (all sequences).

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/mechanics/symbols.hpp"

namespace qdot {

struct Turn {
  Vector axis;  ///< n, of unit length
  Expression angle;
};

/// R v: the space components of a vector with body components v.
[[nodiscard]] Vector turned(std::span<const Turn> turns, const Vector& v);

/// Omega. `rates` are the pairs (x, x') of everything that varies.
[[nodiscard]] Vector body_angular_velocity(Graph& graph, std::span<const Turn> turns,
                                           std::span<const Replacement> rates);

/// omega.
[[nodiscard]] Vector space_angular_velocity(Graph& graph, std::span<const Turn> turns,
                                            std::span<const Replacement> rates);

/// The axes 0, 1, 2 of turns, in their order, of a sequence such as ZXZ. Capital letters: axes that turn with
/// the body, Goldstein's z, x', z''. Small letters: the fixed axes of space, which are the same turns in the
/// opposite order. No value for anything else.
struct TurnSequence {
  std::vector<std::size_t> axes;
  bool backwards{};  ///< small letters: the last angle belongs to the first turn
};
[[nodiscard]] std::optional<TurnSequence> turn_sequence(const std::string& letters);

}  // namespace qdot
