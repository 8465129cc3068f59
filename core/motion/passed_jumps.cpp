#include "core/motion/passed_jumps.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/root.hpp"

namespace qdot {
namespace {

constexpr double roundings_of_instant = 64;

/// Whether the event of a jump is met where the jump is.
bool is_met(const std::vector<Watch>& watches, const EventOccurrence& jump, const Run& done) {
  return std::ranges::any_of(done.events, [&](const EventOccurrence& other) {
    if (other.event >= watches.size() || watches[other.event].kind != Watch::Kind::event) return false;
    const bool is_same = watches[other.event].name == watches[jump.event].name;
    return is_same && std::abs(other.t - jump.t) <= roundings_of_instant * time_round_off(jump.t);
  });
}

}  // namespace

void note_passed_jumps(const MotionSections& sections, const Run& done, Simulation& motion) {
  const std::vector<Watch>& watches = sections.watches();
  for (const EventOccurrence& jump : done.events) {
    if (jump.event >= watches.size() || !sections.is_jump(jump.event) || is_met(watches, jump, done))
      continue;
    Approach place{.event = jump.event,
                   .t = jump.t,
                   .sign = 1,
                   .is_hidden = true,
                   .rows = sections.rows(jump.t, jump.y)};
    motion.near_events.push_back(sections.approach(std::move(place), motion.t));
  }
}

}  // namespace qdot
