#include "core/motion/conditions_after_impact.hpp"

#include <cmath>

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

std::vector<Approach> conditions_near_zero(const MotionSections& sections, const SectionRecord& impact) {
  std::vector<Approach> found;
  for (std::size_t i = 0; i < sections.watches().size(); ++i) {
    const Watch& watch = sections.watches()[i];
    if (watch.kind != Watch::Kind::validity) continue;
    const double before = watch.value(impact.t, impact.before), after = watch.value(impact.t, impact.after);
    if (!(std::abs(after) <= near_zero * std::abs(before))) continue;
    Approach& place = found.emplace_back();
    place.event = i;
    place.t = impact.t;
    if (after < 0) place.met = impact.t;
    place.sign = 1;
    place.distance = std::abs(after);
    place.rows = rows_after(sections, impact);
  }
  return found;
}

}  // namespace qdot
