#include "core/turning/phase_path.hpp"

#include <algorithm>
#include <cmath>

namespace qdot {
namespace {

/// sqrt(2 Q/A), Q from the divided difference of U at the nearer turning point.
double phase_rate(EnergyBalance& energy, const Interval& a, const Interval& b, double x) {
  const bool near_a = x - a.middle() < b.middle() - x;
  const Interval q = near_a ? -energy.potential_slope(a, x) / (b - Interval(x))
                            : energy.potential_slope(b, x) / (Interval(x) - a);
  return std::sqrt(std::max(0.0, 2 * q.middle() / energy.inertia(x).middle()));
}

}  // namespace

PhasePath libration_path(EnergyBalance& energy, const Interval& a, const Interval& b) {
  const double middle = a.middle() / 2 + b.middle() / 2;
  const double half = b.middle() / 2 - a.middle() / 2;
  return [&energy, a, b, middle, half](double phase) {
    const double sine = evaluate(Function::sin, phase);
    const double x = middle + half * evaluate(Function::cos, phase);
    return std::pair(x, -half * sine * phase_rate(energy, a, b, x));
  };
}

PhasePath rotation_path(EnergyBalance& energy, double x0_dot) {
  return [&energy, x0_dot](double phase) {
    const double x = energy.x0() + phase;
    const double speed = std::sqrt(2 * energy.remaining(x).middle() / energy.inertia(x).middle());
    return std::pair(x, std::copysign(speed, x0_dot));
  };
}

}  // namespace qdot
