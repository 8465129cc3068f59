#include "core/gait/strides_that_settle.hpp"

#include <algorithm>
#include <cmath>

namespace qdot {
namespace {

constexpr double strides_rtol = 1e-8;
constexpr int most_strides = 60;
constexpr double hardly = 0.05, much_less = 0.1, no_more = 1e-7;  // changes of a stride, relative
constexpr double known_place = 0.1;

Recurrence recurrence(const SectionMap& map, const Stride& stride) {
  return {map.section(stride.before), stride.duration};
}

double change(const Recurrence& from, const Recurrence& to) {
  return std::max((to.u - from.u).norm() / to.u.norm(), std::abs(to.duration - from.duration) / to.duration);
}

}  // namespace

std::optional<Recurrence> where_strides_settle(SectionMap& map, double haste,
                                               const std::vector<Recurrence>& known,
                                               const IgnoredByGait& gait_near) {
  const auto first = map.first_stride(haste, strides_rtol);
  if (!first) return std::nullopt;
  Recurrence at = recurrence(map, *first);
  double worth_a_look = hardly;
  for (int i = 0; i < most_strides; ++i) {
    const auto stride = map.stride(at.u, strides_rtol);
    if (!stride) return std::nullopt;
    Recurrence next = recurrence(map, *stride);
    const double changed = change(at, next);
    if (!std::isfinite(changed)) return std::nullopt;
    at = std::move(next);
    if (changed > worth_a_look) continue;
    if (std::ranges::any_of(known, [&](const Recurrence& other) { return change(at, other) < known_place; }))
      return std::nullopt;
    if (gait_near(at)) return at;
    if (changed < no_more) return std::nullopt;
    worth_a_look = much_less * changed;
  }
  return std::nullopt;
}

}  // namespace qdot
