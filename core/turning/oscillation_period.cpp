#include "core/turning/oscillation_period.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/constants.hpp"
#include "core/numerics/double_double_function.hpp"
#include "core/turning/period_pieces.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_period_pieces = 4000;
/// A piece is short enough when it leaves this much of its time open, or of what has passed before it.
constexpr double wanted = 0x1p-56;
constexpr double share_of_past = 0.0625;
constexpr double first_length = 0.1;

Finding unknown() {
  return {
      std::nullopt, 0,
      "The speed could not be enclosed well enough all along the motion: it comes too near to rest on the "
      "way, or the potential varies too fast for the work allowed."};
}

/// Walks along s in pieces that are as long as the wanted error allows.
class Walk {
 public:
  Walk(PeriodPieces& pieces, const PeriodEnd* end) : pieces_(pieces), end_(end) {}

  Ball duration(double from, double to) {
    Ball sum;
    double length = first_length;
    for (std::size_t tries = 0; from < to; ++tries) {
      const bool last = tries >= most_period_pieces;
      const double next = last ? to : ahead(from, to, length);
      const PeriodPiece piece = pieces_.between(from, next, end_);
      const double enough = wanted * std::max(least(piece.time), share_of_past * least(sum));
      const bool shortest = from / 2 + next / 2 <= from || from / 2 + next / 2 >= next;
      length = (next - from) * better_factor(piece, enough);
      if (!(piece.truncation <= enough) && !shortest && !last) continue;
      sum = sum + piece.time;
      if (end_ != nullptr && from == 0) length *= 2;  // the first one reaches to one side only
      from = next;
    }
    return sum;
  }

 private:
  static double least(const Ball& time) {
    return time.is_finite() ? std::max(0.0, time.interval().lower) : 0;
  }

  /// Without leaving a sliver before the end.
  static double ahead(double from, double to, double length) {
    const double rest = to - from;
    if (rest <= length) return to;
    const double next = from + (rest < 2 * length ? rest / 2 : length);
    return next > from ? std::min(next, to) : std::min(std::nextafter(from, infinity), to);
  }

  /// By how much a piece should be longer: the truncation goes with a power of it.
  static double better_factor(const PeriodPiece& piece, double enough) {
    constexpr double safety = 0.9, least_factor = 0.25, most_factor = 2;
    const double ratio = enough / piece.truncation;
    if (!(ratio > 0)) return least_factor;
    if (!std::isfinite(ratio)) return most_factor;
    return std::clamp(safety * power(ratio, 1 / static_cast<double>(piece.order)), least_factor, most_factor);
  }

  PeriodPieces& pieces_;
  const PeriodEnd* end_;
};

Finding finding_of(const Ball& period) {
  if (!period.is_finite() || period.contains_zero()) return unknown();
  return {period.value(), period.error(), ""};
}

}  // namespace

Finding libration_period(EnergyBalance& energy, const Interval& a, const Interval& b) {
  PeriodPieces pieces(energy);
  const Ball left = turning_place(energy, a), right = turning_place(energy, b), span = right - left;
  if (span.contains_zero() || !(a.upper < b.lower)) return unknown();
  const PeriodEnd from_left{left, span}, from_right{right, -span};
  const Ball halves =
      Walk(pieces, &from_left).duration(0, pi / 4) + Walk(pieces, &from_right).duration(0, pi / 4);
  // Both halves end a little before the middle, and |b - a| ds = dx there.
  const Ball gap = Ball(pi_double_double, 1e-32) * Ball(0.5) - Ball(pi / 4) - Ball(pi / 4);
  const Ball middle = left + span * Ball({0.5, 0}, 1e-15);
  const Interval rest = gap.interval() * span.interval() * pieces.slowness(middle.interval());
  return finding_of(Ball(2) * (halves + Ball::of(rest)));
}

namespace {

/// From one wall to the other.
Ball between_walls(PeriodPieces& pieces, const Ball& a, const Ball& b) {
  const double from = a.value(), to = b.value();
  const auto beyond = [&](const Ball& end, double place) {
    return (end - Ball(place)).interval() * pieces.slowness(hull(end.interval(), place));
  };
  const Interval rest = beyond(b, to) - beyond(a, from);
  return Walk(pieces, nullptr).duration(from, to) + Ball::of(rest);
}

/// x = a + way sin^2 s with a wall where s = pi/4.
Ball from_turning_point(PeriodPieces& pieces, const Ball& a, const Ball& wall) {
  const Ball way = Ball(2) * (wall - a);
  const PeriodEnd end{a, way};
  const Ball time = Walk(pieces, &end).duration(0, pi / 4);
  const Ball gap = Ball(pi_double_double, 1e-32) * Ball(0.25) - Ball(pi / 4);
  const Interval size(way.interval().magnitude());
  return time + Ball::of(gap.interval() * size * pieces.slowness(wall.interval()));
}

}  // namespace

Finding elastic_period(EnergyBalance& energy, const ElasticEnd& a, const ElasticEnd& b) {
  PeriodPieces pieces(energy);
  if ((b.place - a.place).contains_zero()) return unknown();
  const Ball time = a.is_wall && b.is_wall ? between_walls(pieces, a.place, b.place)
                    : a.is_wall
                        ? from_turning_point(pieces, turning_place(energy, b.place.interval()), a.place)
                        : from_turning_point(pieces, turning_place(energy, a.place.interval()), b.place);
  return finding_of(Ball(2) * time);
}

Finding rotation_period(EnergyBalance& energy) {
  PeriodPieces pieces(energy);
  const double from = energy.x0(), to = from + 2 * pi;
  const Ball end = Ball(from) + Ball(2) * Ball(pi_double_double, 1e-32);
  const Interval rest = (end - Ball(to)).interval() * pieces.slowness(hull(end.interval(), to));
  return finding_of(Walk(pieces, nullptr).duration(from, to) + Ball::of(rest));
}

}  // namespace qdot
