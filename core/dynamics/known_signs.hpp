#pragma once
// States that are not on a kink or a jump of the scene, so that every sign in its functions is known: there
// their values can be computed, whatever a motion does that reaches a kink.

#include "core/dynamics/columns.hpp"
#include "core/mechanics/model.hpp"
#include "core/numerics/real.hpp"

namespace qdot {

/// Whether no argument of an abs or a sign in the equations of motion and in the columns is 0, nor nearer to
/// 0 than rounding tells.
[[nodiscard]] bool signs_are_known(const Model& model, const std::vector<Column>& columns,
                                   const Reals& parameters, double t, const Reals& y);

}  // namespace qdot
