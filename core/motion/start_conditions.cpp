#include "core/motion/start_conditions.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace qdot {
namespace {

/// Where the value is rounding a moment later tells; where that is, too, the first step does.
bool holds(const Watch& watch, const RightHandSide& system, const MotionStart& start) {
  const double value = watch.value(start.t, start.y);
  double rounding = watch.rounding(start.t, start.y);
  if (!std::isfinite(rounding)) rounding = 0;
  if (!(std::abs(value) <= rounding)) return !(value < 0);
  const double h = 1e-9 * std::min(1.0, start.span);
  std::vector<double> y = start.y, slope(y.size());
  if (system.derivative(start.t, y, slope) != Evaluation::ok) return true;
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += h * slope[i];
  const double later = watch.value(start.t + h, y);
  return std::abs(later) <= rounding || !(later < 0);
}

}  // namespace

void check_configuration(std::span<const Watch> watches, const MotionStart& start) {
  for (const Watch& watch : watches) {
    if (watch.kind != Watch::Kind::singularity) continue;
    const double value = watch.value(start.t, start.y);
    if (watch.direction == Crossing::falling ? value > 0 : value != 0) continue;
    throw Error(ErrorCode::invalid_state, watch.message);
  }
}

const Watch* failing_at_start(std::span<const Watch> watches, const RightHandSide& system,
                              const MotionStart& start, const std::function<int(const Watch&)>& exact) {
  for (const Watch& watch : watches) {
    if (watch.kind != Watch::Kind::validity) continue;
    const int sign = exact(watch);
    if (sign == 0 ? !holds(watch, system, start) : sign < 0) return &watch;
  }
  return nullptr;
}

}  // namespace qdot
