#pragma once
// The time that a motion takes for a piece of its way, enclosed. The energy leaves 1/2 A(x) x'^2 = F(x)
// (core/turning/energy_balance.hpp), so that dt = sqrt(A/(2 F)) dx [s]. Between two turning points a and b,
// where F vanishes,
//
//   x = a + (b - a) sin^2 s,   dt = sqrt(2) |b - a| sin s cos s sqrt(A/F) ds = sqrt(p/q) ds,
//   p = 4 sin^2 s cos^2 s A,   q = 2 F/(b - a)^2,
//
// with x = a at s = 0 and x = b at s = pi/2. The zeros of q at both ends are those of p, so that dt/ds is
// smooth all the way; at a itself s^2 is taken out of both. For one turn of an angle s = x, p = A, q = 2 F.
// Source: Landau, Lifshitz, Mechanics, 3rd ed., section 11, for dt; the substitution is the usual one for
// integrands with square roots of zeros at both ends.

#include "core/turning/energy_balance.hpp"

namespace qdot {

/// A turning point and the way from there to the other one, with more digits than a double has.
struct PeriodEnd {
  Ball place, way;
};

/// `place` holds one zero of F.
[[nodiscard]] Ball turning_place(EnergyBalance& energy, const Interval& place);

struct PeriodPiece {
  Ball time;            ///< not finite where F cannot be told from 0 [s]
  double truncation{};  ///< how much narrower `time` would be with pieces shorter than this
  std::size_t order{};  ///< with which power of its length the truncation falls
};

class PeriodPieces {
 public:
  explicit PeriodPieces(EnergyBalance& energy) : energy_(energy) {}

  /// The time from s = `from` to s = `to`; `end`: the turning point where s = 0, null for a turn.
  [[nodiscard]] PeriodPiece between(double from, double to, const PeriodEnd* end);
  /// dt/dx = sqrt(A/(2 F)) on all of x; the whole line where F may vanish there.
  [[nodiscard]] Interval slowness(const Interval& x);

 private:
  EnergyBalance& energy_;
};

}  // namespace qdot
