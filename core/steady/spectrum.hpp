#pragma once
// All s of (s^2 M + s D + K) v = 0 with proven bounds, multiple and nearly multiple ones included.
// Coordinates that act on others without being acted upon split the problem: with the coordinates in that
// order M, D and K are block triangular, and the s are those of the blocks on the diagonal (Horn, Johnson,
// Matrix Analysis, 6.2), so that a one-way chain of equal oscillators has its rates to all digits.

#include <vector>

#include "core/numerics/eigenvalue_clusters.hpp"
#include "core/steady/small_motions.hpp"

namespace qdot {

struct Exponent {
  ComplexBall middle;     ///< of no radius
  double radius{};        ///< of a disc that holds all members; not finite where nothing could be proven
  std::size_t members{};  ///< eigenvalues in the disc
  bool undamped{};        ///< the real part is proven to be 0
};

/// 2n of them; the members of one disc stand beside each other with one disc.
[[nodiscard]] std::vector<Exponent> spectrum(const SmallMotions& motions);

enum class Damping { all_decay, one_grows, undecided };
/// What the signs of the real parts are proven to be.
[[nodiscard]] Damping damping_of(const std::vector<Exponent>& exponents);

}  // namespace qdot
