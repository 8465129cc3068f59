#include "core/turning/period_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/work.hpp"
#include "core/numerics/root_quadrature.hpp"

namespace qdot {
namespace {

using Series = TaylorEnclosure<quadrature_order>;

/// The highest order up to which coefficients exist all over the piece, `beyond` more being needed of U.
std::size_t usable_order(const EnergySeries& series, std::size_t beyond) {
  std::size_t n = quadrature_order - beyond;
  while (n > 1 && !(series.potential.over[n + beyond].is_finite() && series.inertia.over[n].is_finite())) --n;
  return n;
}

/// The coefficients of f(sign h t) up to the order n; the last one for all of the piece.
std::vector<Interval> scaled(const Series& f, std::size_t n, const Interval& h, double sign) {
  std::vector<Interval> result(n + 1);
  Interval power(1);
  for (std::size_t k = 0; k <= n; ++k) {
    result[k] = (k < n ? f.at[k] : f.over[k]) * power;
    power = power * h * Interval(sign);
  }
  return result;
}

/// A row of coefficients takes this much more work than a value.
void count_work() { spend_work(quadrature_order * quadrature_order); }

}  // namespace

PeriodEnd turning_end(EnergyBalance& energy, const Interval& place, double inward) {
  PeriodEnd end{place.middle(), {}, {}, inward};
  const Interval everywhere = place - Interval(end.near);
  end.offset = everywhere;
  const Interval remaining = intersection(energy.remaining(end.near), energy.remaining_sharply(end.near));
  const Interval rate =
      intersection(energy.potential_rate_sharply(end.near), energy.potential_rate(end.near));
  const Interval stiffness = energy.stiffness(place);
  constexpr int refinements = 4;
  for (int i = 0; i < refinements && stiffness.is_finite(); ++i) {  // 0 = F(near) - offset U[near, a]
    const Interval slope = rate + end.offset * stiffness * Interval(0.5);
    const Interval next = intersection(remaining / slope, end.offset);
    if (!is_empty(next)) end.offset = next;
  }
  const Interval slope = rate + end.offset * stiffness;
  end.slope = stiffness.is_finite() ? intersection(slope, energy.potential_rate(place)) : Interval::whole();
  return end;
}

Interval PeriodPieces::slowness(const Interval& x) {
  const Interval remaining = energy_.remaining(x);
  return remaining.lower > 0 ? sqrt(energy_.inertia(x) / (Interval(2) * remaining)) : Interval::whole();
}

PeriodPiece PeriodPieces::between(double from, double to) {
  count_work();
  const double centre = from / 2 + to / 2;
  const Interval piece(from, to);
  const Interval left = Interval(from) - Interval(centre), right = Interval(to) - Interval(centre);
  const Interval h(std::max(left.magnitude(), right.magnitude()));
  const EnergySeries series = energy_.series(centre, piece);
  const std::size_t n = usable_order(series, 0);
  std::vector<Interval> doubled = scaled(series.potential, n, h, 1);  // of 2 F = 2 (h - U)
  for (Interval& coefficient : doubled) coefficient = Interval(-2) * coefficient;
  doubled[0] = Interval(2) * intersection(energy_.remaining(centre), energy_.remaining_sharply(centre));
  if (n > 1) {
    const Interval sharp = Interval(-2) * h * energy_.potential_rate_sharply(centre);
    doubled[1] = intersection(doubled[1], sharp);
  }
  const std::vector<Interval> inertia = scaled(series.inertia, n, h, 1);
  const EnclosedIntegral integral =
      integral_of_root({inertia, energy_.inertia(piece)}, {doubled, Interval(2) * energy_.remaining(piece)},
                       left / h, right / h);
  return {from, to, std::nullopt, h * integral.value, h.upper * integral.truncation};
}

PeriodPiece PeriodPieces::beside(const PeriodEnd& end, double to) {
  count_work();
  const Interval a = Interval(end.near) + end.offset;
  const Interval piece = hull(a, to);
  const Interval length = Interval(end.inward) * (Interval(to) - Interval(end.near) - end.offset);
  PeriodPiece result{end.near, to, end, Interval::whole(), 0};
  result.truncation = result.time.width();
  if (!(length.lower > 0)) return result;
  const Interval h(length.upper);
  EnergySeries series = energy_.series(a, piece);
  series.potential.at[1] = intersection(series.potential.at[1], end.slope);
  const std::size_t n = usable_order(series, 1);
  Series quotient;  // of G: U_{k+1}
  std::copy(series.potential.at.begin() + 1, series.potential.at.end(), quotient.at.begin());
  std::copy(series.potential.over.begin() + 1, series.potential.over.end(), quotient.over.begin());
  std::vector<Interval> doubled = scaled(quotient, n, h, end.inward);
  for (Interval& coefficient : doubled) coefficient = Interval(-2 * end.inward) * coefficient;
  const std::vector<Interval> inertia = scaled(series.inertia, n, h, end.inward);
  const Interval range = Interval(-2 * end.inward) * energy_.potential_slope(a, piece);
  const EnclosedIntegral integral =
      integral_of_singular_root({inertia, energy_.inertia(piece)}, {doubled, range}, length / h);
  const Interval scale = sqrt(h);
  result.time = scale * integral.value;
  result.truncation = scale.upper * integral.truncation;
  return result;
}

std::optional<std::array<PeriodPiece, 2>> PeriodPieces::halves(const PeriodPiece& piece) {
  if (piece.end) {
    const double middle = piece.from + (piece.to - piece.from) / 4;
    const Interval a = Interval(piece.end->near) + piece.end->offset;
    if (middle == piece.from || middle == piece.to || a.contains(middle)) return std::nullopt;
    return std::array{beside(*piece.end, middle),
                      between(std::min(middle, piece.to), std::max(middle, piece.to))};
  }
  const double middle = piece.from / 2 + piece.to / 2;
  if (middle <= piece.from || middle >= piece.to) return std::nullopt;
  return std::array{between(piece.from, middle), between(middle, piece.to)};
}

}  // namespace qdot
