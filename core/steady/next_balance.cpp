#include "core/steady/next_balance.hpp"

#include <algorithm>
#include <cmath>

namespace qdot {

ForceAlongLine::ForceAlongLine(const Statics& statics, const SmoothForces& smooth,
                               std::span<const Interval> constants, std::vector<Interval> place,
                               std::size_t unknown)
    : unknown_(unknown),
      unknowns_(place.size()),
      kinks_(smooth.kinks()),
      forces_(statics.forces, constants),
      stiffness_(statics.stiffness, constants),
      arguments_(smooth.arguments, constants),
      x_(std::move(place)),
      g_(unknowns_),
      k_(unknowns_ * unknowns_),
      u_(kinks_) {
  x_.resize(unknowns_ + kinks_, Interval(-1, 1));
}

Interval ForceAlongLine::force(const Interval& x) {
  x_[unknown_] = x;
  forces_(std::span(x_).first(unknowns_), g_);
  return g_[unknown_];
}

std::optional<Interval> ForceAlongLine::slope(const Interval& x) {
  x_[unknown_] = x;
  if (kinks_ > 0) arguments_(x_, u_);
  if (std::ranges::any_of(u_, [](const Interval& u) { return u.contains(0.0); })) return std::nullopt;
  if (!force(x).is_finite()) return std::nullopt;
  stiffness_(std::span(x_).first(unknowns_), k_);
  return k_[unknown_ * unknowns_ + unknown_];
}

namespace {

/// -1, 1, or 0 where it is not known.
int sign_of(const Interval& a) { return a.lower > 0 ? 1 : a.upper < 0 ? -1 : 0; }

/// Halves it as long as the middle's side is known.
Interval narrowed(ForceAlongLine& line, Interval around) {
  for (int i = 0; i < 40; ++i) {
    const double middle = around.middle();
    const int sign = sign_of(line.force(middle));
    if (sign == 0) break;
    (sign > 0 ? around.upper : around.lower) = middle;
  }
  return around;
}

}  // namespace

std::optional<Interval> next_balance(ForceAlongLine& line, double start, double size) {
  constexpr int most_intervals = 400;
  const int uphill = sign_of(line.force(start));
  double at = start, length = size / 64;
  if (uphill == 0) return std::nullopt;
  for (int i = 0; i < most_intervals; ++i) {
    const double to = at - uphill * length;
    const Interval piece(std::min(at, to), std::max(at, to));
    if (to == at || !piece.is_finite()) return std::nullopt;
    const auto slope = line.slope(piece);
    const auto keeps_sign = [&] {
      if (sign_of(line.force(piece)) == uphill) return true;
      return slope && sign_of(line.force(at) + *slope * (piece - Interval(at))) == uphill;
    };
    const int beyond = slope && slope->lower > 0 ? sign_of(line.force(to)) : 0;
    if (beyond == -uphill) return narrowed(line, piece);
    if (beyond == uphill || keeps_sign()) {
      at = to;
      length *= 2;
    } else {
      length /= 2;
    }
  }
  return std::nullopt;
}

}  // namespace qdot
