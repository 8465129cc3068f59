#include "core/turning/energy_balance.hpp"

namespace qdot {
namespace {

std::vector<DividedDifference> unchanging(std::span<const Ball> constants) {
  std::vector<DividedDifference> result;
  result.reserve(constants.size());
  for (const Ball& c : constants) result.push_back(DividedDifference::constant(interval_of(c)));
  return result;
}

std::vector<Interval> intervals_of(std::span<const Ball> constants) {
  std::vector<Interval> result;
  result.reserve(constants.size());
  for (const Ball& c : constants) result.push_back(interval_of(c));
  return result;
}

template <class Number>
Number value(TapeEvaluator<Number>& function, const Number& x) {
  Number out;
  function({&x, 1}, {&out, 1});
  return out;
}

}  // namespace

Interval interval_of(const Ball& ball) {
  const double error = ball.error();
  if (error == 0) return ball.value();
  return Interval(ball.value()) + Interval(-error, error);
}

EnergyBalance::EnergyBalance(const Statics& statics, std::span<const Ball> constants, double x0,
                             double x0_dot)
    : potential_(*statics.potential, unchanging(constants)),
      rate_(statics.forces, intervals_of(constants)),
      stiffness_(statics.stiffness, intervals_of(constants)),
      inertia_(statics.inertia, intervals_of(constants)),
      sharp_potential_(*statics.potential, constants),
      sharp_inertia_(statics.inertia, constants),
      x0_(x0),
      x0_dot_(x0_dot),
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

Interval EnergyBalance::remaining_sharply(double x) {
  const Ball change = value(sharp_potential_, Ball(x)) - value(sharp_potential_, Ball(x0_));
  const Ball start = value(sharp_inertia_, Ball(x0_)) * square(Ball(x0_dot_)) * Ball(0.5);
  return interval_of(start - change);
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
