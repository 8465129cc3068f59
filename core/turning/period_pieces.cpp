#include "core/turning/period_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/work.hpp"
#include "core/numerics/root_quadrature.hpp"

namespace qdot {
namespace {

/// p and q as series in s, and what is known of their ranges.
struct Integrand {
  FineSeries p, q;
  Interval p_range, q_range;
  std::size_t taken_out{};  ///< powers of s that are taken out of both
};

/// The highest order up to which coefficients exist all over the piece.
std::size_t usable_order(const Integrand& f) {
  std::size_t n = quadrature_order - f.taken_out;
  while (n > 1 && !(f.p.over[n + f.taken_out].is_finite() && f.q.over[n + f.taken_out].is_finite())) --n;
  return n;
}

/// The coefficients of f(h t)/(h t)^taken_out up to the order n; the last one for all of the piece.
std::vector<Ball> scaled(const FineSeries& f, std::size_t taken_out, std::size_t n, double h) {
  std::vector<Ball> result(n + 1);
  Ball power(1);
  for (std::size_t k = 0; k <= n; ++k) {
    result[k] = (k < n ? f.at[k + taken_out] : Ball::of(f.over[k + taken_out])) * power;
    power = power * Ball(h);
  }
  return result;
}

/// A row of coefficients takes this much more work than a value.
void count_work() { spend_work(quadrature_order * quadrature_order); }

const Ball& narrower(const Ball& a, const Ball& b) { return b.radius < a.radius ? b : a; }

Integrand of_turn(EnergyBalance& energy, const FineSeries& s) {
  EnergySeries series = energy.along(s);
  Ball& centre = series.remaining.at[0];
  centre = narrower(centre, Ball::of(energy.remaining(s.at[0].interval())));
  const FineSeries q = FineSeries::literal(2) * series.remaining;
  return {series.inertia, q, series.inertia.over[0], Interval(2) * series.remaining.over[0]};
}

Integrand of_libration(EnergyBalance& energy, const PeriodEnd& end, const FineSeries& s) {
  const auto [sine, cosine] = sine_cosine(s);
  const FineSeries sine2 = square(sine), cosine2 = square(cosine);
  FineSeries x = FineSeries::constant(end.place) + FineSeries::constant(end.way) * sine2;
  x.over[0] = intersection(x.over[0], hull(end.place.interval(), (end.place + end.way).interval()));
  EnergySeries series = energy.along(x);
  // Of small motions h and U nearly cancel; U[a, x] does not.
  const Interval slope = energy.potential_slope(end.place.interval(), x.at[0].interval());
  Ball& centre = series.remaining.at[0];
  centre = narrower(centre, -(end.way * sine2.at[0] * Ball::of(slope)));
  Integrand f;
  f.p = FineSeries::literal(4) * (sine2 * cosine2) * series.inertia;
  const Ball scale = Ball(1) / end.way;
  f.q = FineSeries::constant(Ball(2) * scale * scale) * series.remaining;
  f.p_range = f.p.over[0];
  f.q_range = Interval(2) * square(scale.interval()) * series.remaining.over[0];
  if (!is_zero(s.at[0].interval())) return f;
  f.taken_out = 2;
  const Interval reach(s.over[0].upper);
  const Interval sinc2 = square(hull(1, sin(reach) / reach));
  f.p_range = Interval(4) * sinc2 * cosine2.over[0] * series.inertia.over[0];
  f.q_range = Interval(-2) * sinc2 * scale.interval() *
              energy.potential_slope(end.place.interval(), x.over[0]);  // F = -(x - a) U[a, x]
  return f;
}

}  // namespace

Ball turning_place(EnergyBalance& energy, const Interval& place) {
  const double near = place.middle();
  Interval offset = place - Interval(near);
  const Interval remaining = intersection(energy.remaining(near), energy.remaining_sharply(near));
  const Interval rate = intersection(energy.potential_rate_sharply(near), energy.potential_rate(near));
  const Interval stiffness = energy.stiffness(place);
  constexpr int refinements = 4;
  for (int i = 0; i < refinements && stiffness.is_finite(); ++i) {  // 0 = F(near) - offset U[near, a]
    const Interval slope = rate + offset * stiffness * Interval(0.5);
    const Interval next = intersection(remaining / slope, offset);
    if (!is_empty(next)) offset = next;
  }
  return Ball(near) + Ball::of(offset);
}

Interval PeriodPieces::slowness(const Interval& x) {
  const Interval remaining = energy_.remaining(x);
  return remaining.lower > 0 ? sqrt(energy_.inertia(x) / (Interval(2) * remaining)) : Interval::whole();
}

PeriodPiece PeriodPieces::between(double from, double to, const PeriodEnd* end) {
  count_work();
  const double centre = end != nullptr && from == 0 ? 0 : from / 2 + to / 2;
  const Ball left = Ball(from) - Ball(centre), right = Ball(to) - Ball(centre);
  const double h = std::max(left.magnitude(), right.magnitude());
  const FineSeries s = FineSeries::variable(Ball(centre), {from, to});
  const Integrand f = end != nullptr ? of_libration(energy_, *end, s) : of_turn(energy_, s);
  const std::size_t n = usable_order(f);
  const EnclosedIntegral integral =
      integral_of_root({scaled(f.p, f.taken_out, n, h), f.p_range},
                       {scaled(f.q, f.taken_out, n, h), f.q_range}, left / Ball(h), right / Ball(h));
  return {Ball(h) * integral.value, h * integral.truncation, n};
}

}  // namespace qdot
