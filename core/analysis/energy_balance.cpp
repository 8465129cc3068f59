#include "core/analysis/energy_balance.hpp"

namespace qdot {
namespace {

std::vector<DividedDifference> unchanging(std::span<const Interval> constants) {
  std::vector<DividedDifference> result;
  result.reserve(constants.size());
  for (const Interval& c : constants) result.push_back(DividedDifference::constant(c));
  return result;
}

Interval value(TapeEvaluator<Interval>& function, const Interval& x) {
  Interval out;
  function({&x, 1}, {&out, 1});
  return out;
}

}  // namespace

EnergyBalance::EnergyBalance(const Statics& statics, std::span<const Interval> constants, double x0,
                             double x0_dot)
    : potential_(*statics.potential, unchanging(constants)),
      rate_(statics.forces, constants),
      stiffness_(statics.stiffness, constants),
      inertia_(statics.inertia, constants),
      x0_(x0),
      at_rest_(x0_dot == 0) {
  if (!at_rest_) kinetic_energy_ = inertia(x0) * square(Interval(x0_dot)) * Interval(0.5);
}

Interval EnergyBalance::remaining(const Interval& x) {
  const DividedDifference place = DividedDifference::variable(x0_, x);
  DividedDifference u;
  potential_({&place, 1}, {&u, 1});
  const Interval change = intersection((x - Interval(x0_)) * u.slope, u.at_b - u.at_a);
  return at_rest_ ? -change : kinetic_energy_ - change;
}

Interval EnergyBalance::potential_slope(const Interval& a, const Interval& x) {
  const DividedDifference place = DividedDifference::variable(a, x);
  DividedDifference u;
  potential_({&place, 1}, {&u, 1});
  return u.slope;
}

Interval EnergyBalance::potential(const Interval& x) {
  const DividedDifference place = DividedDifference::constant(x);
  DividedDifference u;
  potential_({&place, 1}, {&u, 1});
  return u.at_b;
}

Interval EnergyBalance::potential_rate(const Interval& x) { return value(rate_, x); }
Interval EnergyBalance::stiffness(const Interval& x) { return value(stiffness_, x); }
Interval EnergyBalance::inertia(const Interval& x) { return value(inertia_, x); }

}  // namespace qdot
