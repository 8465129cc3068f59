#include "core/motion/computed_motion.hpp"

#include "core/integrate/methods.hpp"

namespace qdot {

bool ComputedMotion::is_near_round_off() const {
  return record_of(simulation.method).has_fixed_step() || tolerances.rtol <= near_round_off ||
         simulation.begins_beside_kink;
}

bool ComputedMotion::has_events_in_doubt() const {
  const bool is_far_off = !record_of(simulation.method).expands() || tolerances.rtol >= loose_tolerance;
  return is_far_off && !request.events.empty();
}

}  // namespace qdot
