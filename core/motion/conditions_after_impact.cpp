#include "core/motion/conditions_after_impact.hpp"

#include <cmath>
#include <utility>

#include "core/integrate/approaches.hpp"

namespace qdot {
void note_conditions(const MotionSections& sections, std::span<const double> apart,
                     std::span<const double> unseen, Simulation& motion) {
  const SectionRecord& impact = motion.sections.back();
  for (std::size_t i = 0; i < sections.watches().size(); ++i) {
    const Watch& watch = sections.watches()[i];
    if (watch.kind != Watch::Kind::validity) continue;
    const double before = watch.value(impact.t, impact.before), after = watch.value(impact.t, impact.after);
    const bool is_left_alone = before == after;
    if (is_left_alone || !(std::abs(after) <= near_zero * std::abs(before))) continue;
    Approach place{.event = i,
                   .t = impact.t,
                   .sign = 1,
                   .distance = std::abs(after),
                   .rows = sections.rows(impact.t, impact.after)};
    place.apart.assign(apart.begin(), apart.end());
    place.unseen.assign(unseen.begin(), unseen.end());
    motion.approaches.push_back(sections.approach(std::move(place), impact.t));
  }
}

void meet_condition(const std::string& name, double t, std::vector<ApproachRecord>& approaches) {
  for (ApproachRecord& approach : approaches) {
    const bool is_at_begin = approach.ends_motion && approach.begun == t && approach.place.t == t;
    if (is_at_begin && approach.name == name) approach.place.met = t;
  }
}

}  // namespace qdot
