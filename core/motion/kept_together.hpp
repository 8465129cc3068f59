#pragma once
// Bodies that a plastic impact has left together, under forces of which doubles do not tell whether they
// press them. Where something presses, however little, they stay together, and each would be elsewhere than
// it is computed to be: by the way k of the contact (Bounce::way) times how far they have gone into each
// other,
//
//   |dq_i| = |k_i| depth,   |dv_i| = |what the impact would change there|,
//
// and after they have parted by that and as far as the velocity goes since.

#include "core/motion/bounce.hpp"
#include "core/motion/computed_motion.hpp"
#include "core/motion/simulation_result.hpp"

namespace qdot {

/// Adds it to `check.unseen`, at those rows of motion.event_rows that come after an impact of this number.
void doubt_kept_together(const ComputedMotion& motion, std::size_t number, Bounce& bounce, Simulation& check);

}  // namespace qdot
