#include "core/turning/energy_balance.hpp"

#include <cmath>

#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

template <class Number>
std::vector<Number> unchanging(std::span<const Ball> constants) {
  std::vector<Number> result;
  result.reserve(constants.size());
  for (const Ball& c : constants) result.push_back(Number::constant(c.interval()));
  return result;
}

std::vector<Interval> intervals_of(std::span<const Ball> constants) {
  std::vector<Interval> result;
  result.reserve(constants.size());
  for (const Ball& c : constants) result.push_back(c.interval());
  return result;
}

/// What nothing is known of.
bool is_whole(const Interval& x) { return x.lower == -infinity && x.upper == infinity; }

/// A place in x to compare the others with.
Interval centre_of(const Interval& x) { return x.is_finite() ? Interval(x.middle()) : x; }

template <class Number>
Number value(TapeEvaluator<Number>& function, const Number& x) {
  Number out;
  function({&x, 1}, {&out, 1});
  return out;
}

}  // namespace

EnergyBalance::EnergyBalance(const Statics& statics, std::span<const Ball> constants, const Real& x0,
                             const Real& x0_dot)
    : potential_(*statics.potential, unchanging<DividedDifference>(constants)),
      rate_(statics.forces, intervals_of(constants)),
      stiffness_(statics.stiffness, intervals_of(constants)),
      inertia_(statics.inertia, intervals_of(constants)),
      sharp_potential_(*statics.potential, constants),
      sharp_rate_(statics.forces, constants),
      sharp_inertia_(statics.inertia, constants),
      curved_potential_(*statics.potential, unchanging<Curvature>(constants)),
      statics_(statics),
      constants_(constants.begin(), constants.end()),
      x0_(x0),
      x0_dot_(x0_dot),
      at_rest_(x0_dot == Real(0)) {
  sharp_start_ = value(sharp_potential_, Ball::literal(x0));
  if (at_rest_) return;
  kinetic_energy_ = inertia(start()) * square(Interval::literal(x0_dot)) * Interval(0.5);
  sharp_kinetic_ = value(sharp_inertia_, Ball::literal(x0)) * square(Ball::literal(x0_dot)) * Ball(0.5);
}

double EnergyBalance::rounding_of_start() {
  const auto half_unit = [](double x) { return (std::nextafter(std::abs(x), infinity) - std::abs(x)) / 2; };
  const double by_rate =
      at_rest_ ? 0 : (inertia(start()) * Interval(x0_dot_.value)).magnitude() * half_unit(x0_dot_.value);
  return by_rate + potential_rate(start()).magnitude() * half_unit(x0_.value);
}

Interval EnergyBalance::remaining(const Interval& x) {
  const DividedDifference place = DividedDifference::variable(start(), x);
  DividedDifference u;
  potential_({&place, 1}, {&u, 1});
  const Interval change = intersection((x - start()) * u.slope, u.at_b - u.at_a);
  return at_rest_ ? -change : kinetic_energy_ - change;
}

Interval EnergyBalance::remaining_sharply(double x) {
  return (sharp_kinetic_ + sharp_start_ - value(sharp_potential_, Ball(x))).interval();
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

Interval EnergyBalance::potential_rate_sharply(double x) {
  return is_whole(stiffness(x)) ? Interval::whole() : value(sharp_rate_, Ball(x)).interval();
}

/// A ball that is no larger than what twice the digits round: where it holds a kink, it has both slopes.
Interval EnergyBalance::potential_rate_at_start() {
  const Interval rate = potential_rate(start());
  if (!rate.contains(0.0)) return rate;
  const double radius = std::max(0x1p-100 * std::abs(x0_.value), 0x1p-1000);
  const Ball x0 = Ball::literal(x0_) + Ball::of(Interval(-radius, radius));
  const Interval sharp = value(sharp_rate_, x0).interval();
  return sharp.is_finite() ? intersection(rate, sharp) : rate;
}

/// The formula of U' is silent about jumps of U, and takes one slope at a kink.
Interval EnergyBalance::potential_rate(const Interval& x) {
  const auto u = value(curved_potential_, Curvature::variable(centre_of(x), x)).over;
  return is_whole(u[2]) ? u[1] : intersection(u[1], value(rate_, x));
}

/// The formula of U'' is silent about kinks.
Interval EnergyBalance::stiffness(const Interval& x) {
  const auto u = value(curved_potential_, Curvature::variable(centre_of(x), x)).over;
  return is_whole(u[2]) ? u[2] : intersection(Interval(2) * u[2], value(stiffness_, x));
}

Interval EnergyBalance::inertia(const Interval& x) { return value(inertia_, x); }

EnergySeries EnergyBalance::along(const FineSeries& x) {
  if (!potential_series_) {
    std::vector<FineSeries> constants;
    for (const Ball& c : constants_) constants.push_back(FineSeries::constant(c));
    potential_series_.emplace(*statics_.potential, constants);
    inertia_series_.emplace(statics_.inertia, constants);
  }
  EnergySeries series{FineSeries::literal(-1) * value(*potential_series_, x), value(*inertia_series_, x)};
  series.remaining.at[0] = sharp_kinetic_ + sharp_start_ + series.remaining.at[0];
  series.remaining.over[0] = remaining(x.over[0]);
  return series;
}

CurvedEnergy EnergyBalance::along(const Curvature& x) {
  if (!curved_inertia_) curved_inertia_.emplace(statics_.inertia, unchanging<Curvature>(constants_));
  CurvedEnergy energy{Curvature::literal(-1) * value(curved_potential_, x), value(*curved_inertia_, x)};
  energy.remaining.at[0] = remaining(x.at[0]);
  energy.remaining.over[0] = remaining(x.over[0]);
  const Interval by_slope = energy.remaining.at[0] + energy.remaining.over[1] * x.reach;
  const Interval both = intersection(energy.remaining.over[0], by_slope);
  if (!is_empty(both)) energy.remaining.over[0] = both;
  return energy;
}

}  // namespace qdot
