#include "core/turning/oscillation_period.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/work.hpp"
#include "core/numerics/constants.hpp"
#include "core/turning/period_pieces.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_period_pieces = 4000;
/// A piece is short enough when it leaves this much of the whole open, or less than its roundings do.
constexpr double wanted = 0x1p-57;
constexpr double share_of_rounding = 0.125;

Finding unknown() {
  return {
      std::nullopt, 0,
      "The speed could not be enclosed well enough all along the motion: it comes too near to rest on the "
      "way, or the potential varies too fast for the work allowed."};
}

/// Pieces in the order of the way, cut until they are good enough or too many.
std::vector<PeriodPiece> refined(PeriodPieces& pieces, std::vector<PeriodPiece> way) {
  for (std::size_t made = way.size(); made < most_period_pieces;) {
    double known = 0;
    for (const PeriodPiece& piece : way) {
      if (piece.time.is_finite()) known += piece.time.lower;
    }
    std::vector<PeriodPiece> next;
    for (const PeriodPiece& piece : way) {
      const double rounding = piece.time.width() - piece.truncation;
      const bool good = piece.truncation <= std::max(wanted * known, share_of_rounding * rounding);
      const auto parts = good || made >= most_period_pieces ? std::nullopt : pieces.halves(piece);
      if (parts) {
        next.insert(next.end(), parts->begin(), parts->end());
        made += 2;
      } else {
        next.push_back(piece);
      }
    }
    if (next.size() == way.size()) break;
    way = std::move(next);
  }
  return way;
}

Interval duration(PeriodPieces& pieces, std::vector<PeriodPiece> way) {
  Interval sum(0);
  for (const PeriodPiece& piece : refined(pieces, std::move(way))) sum = sum + piece.time;
  return sum;
}

Finding finding_of(const Interval& period) {
  if (!period.is_finite()) return unknown();
  return {period.middle(), std::nextafter(period.radius(), infinity), ""};
}

}  // namespace

Finding libration_period(EnergyBalance& energy, const Interval& a, const Interval& b) {
  PeriodPieces pieces(energy);
  const double middle = a.middle() / 2 + b.middle() / 2;
  if (!(a.upper < middle) || !(middle < b.lower)) return unknown();
  const PeriodEnd left = turning_end(energy, a, 1), right = turning_end(energy, b, -1);
  return finding_of(Interval(2) *
                    duration(pieces, {pieces.beside(left, middle), pieces.beside(right, middle)}));
}

Finding rotation_period(EnergyBalance& energy) {
  PeriodPieces pieces(energy);
  const Interval turn = Interval(2) * Interval(std::nextafter(pi, 0), std::nextafter(pi, 4));
  const double from = energy.x0(), to = from + 2 * pi;
  constexpr int first_pieces = 8;
  std::vector<PeriodPiece> way;
  double p = from;
  for (int k = 1; k <= first_pieces; ++k) {
    const double q = k == first_pieces ? to : from + 2 * pi * k / first_pieces;
    way.push_back(pieces.between(p, q));
    p = q;
  }
  const Interval end = Interval(from) + turn;
  const Interval rest = (end - Interval(to)) * pieces.slowness(hull(end, to));
  return finding_of(duration(pieces, std::move(way)) + rest);
}

}  // namespace qdot
