#pragma once
// Which of the constants of a motion are listed. One is a function of others just where its gradient in (x,
// x', t) is a combination of theirs: of two bodies the cross product of their total momentum and their centre
// of mass.

#include <vector>

#include "core/mechanics/conserved.hpp"
#include "core/mechanics/lagrangian.hpp"

namespace qdot {

/// What a symmetry is, for what it keeps to be told from functions of what others keep.
enum class KindOfChange {
  linear,    ///< shifts and uniform motions
  in_space,  ///< turns all bodies
  rotation,  ///< turns each coordinate with one other
  mixed,
  in_time  ///< of the kind of h, which others are not measured by
};

struct Kept {
  ConservedQuantity quantity;
  KindOfChange kind{};
  std::size_t spread{};  ///< how far apart, in the list of coordinates, are those that turn together
};

/// Without what is a function of momenta, of the centre of mass and of other rotations. Angular momenta of
/// bodies are listed in any case, and those of what is free, where momenta alone say as much.
[[nodiscard]] std::vector<ConservedQuantity> listed_quantities(const std::vector<Kept>& all,
                                                               const Lagrangian& lagrangian);

}  // namespace qdot
