#pragma once
// What the conditions of a scene say of the state in which a motion begins.

#include <functional>
#include <span>
#include <vector>

#include "core/dynamics/watch.hpp"
#include "core/integrate/run.hpp"

namespace qdot {

struct MotionStart {
  double t{};
  const std::vector<double>& y;  ///< q, then q'
  double span{};                 ///< how long the motion is to last
};

/// Throws Error(invalid_state) where the state describes no configuration.
void check_configuration(std::span<const Watch> watches, const MotionStart& start);

/// `exact`: the sign of a condition's value, beyond doubles; 0 where that is not known or zero.
/// The first condition because of which the motion is over before it begins; nullptr: none. One that holds
/// with equality fails at once when its value falls from there.
[[nodiscard]] const Watch* failing_at_start(std::span<const Watch> watches, const RightHandSide& system,
                                            const MotionStart& start,
                                            const std::function<int(const Watch&)>& exact);

}  // namespace qdot
