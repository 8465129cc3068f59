#pragma once
// Events whose functions are rounded by as much as they change along a motion: (x + 1e9)^2 - 1e18 - 2e9 x is
// x^2, but all that is seen of it are last digits of 1e18. How often such a one happens no computation tells.

#include <string>

#include "core/motion/motion_check.hpp"

namespace qdot {

/// Of the first such event a sentence; empty: there is none.
[[nodiscard]] std::string event_lost_in_rounding(const ComputedMotion& motion);

}  // namespace qdot
