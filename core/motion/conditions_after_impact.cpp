#include "core/motion/conditions_after_impact.hpp"

#include <cmath>
#include <utility>

#include "core/integrate/approaches.hpp"

namespace qdot {
namespace {

/// y_i(t + s) as far as slopes tell it.
std::vector<double> rows_after(const MotionSections& sections, const SectionRecord& impact) {
  constexpr std::size_t width = Approach::order + 1;
  const std::size_t n = impact.after.size() / 2;
  const std::vector<double> slopes = sections.slopes(impact.t, impact.after);
  std::vector<double> rows(width * impact.after.size());
  for (std::size_t k = 0; k < impact.after.size(); ++k) {
    rows[width * k] = impact.after[k];
    rows[width * k + 1] = slopes[k];
    if (k < n) rows[width * k + 2] = slopes[n + k] / 2;
  }
  return rows;
}

}  // namespace

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
                   .rows = rows_after(sections, impact)};
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
