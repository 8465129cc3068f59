#pragma once
// States beside the kinks and jumps of a scene: what depends on signs there is told by values, whatever a
// motion does that comes to one.

#include "core/dynamics/columns.hpp"
#include "core/mechanics/model.hpp"
#include "core/numerics/real.hpp"

namespace qdot {

/// Whether no argument of an abs or a sign in the equations of motion and in the columns is 0, nor nearer to
/// 0 than rounding tells.
[[nodiscard]] bool signs_are_known(const Model& model, const std::vector<Column>& columns,
                                   const Reals& parameters, double t, const Reals& y);

}  // namespace qdot
