#pragma once
// The time that a motion takes for a piece of its way, integral of sqrt(A/(2 F)) dx, enclosed.

#include <array>
#include <optional>

#include "core/turning/energy_balance.hpp"

namespace qdot {

/// A turning point a = near + offset, with more digits than a double has.
struct PeriodEnd {
  double near{};
  Interval offset;
  Interval slope;   ///< U'(a)
  double inward{};  ///< the motion is at x = a + inward s, s > 0
};

/// `place` holds one zero of F.
[[nodiscard]] PeriodEnd turning_end(EnergyBalance& energy, const Interval& place, double inward);

struct PeriodPiece {
  double from{}, to{};
  std::optional<PeriodEnd> end;  ///< the piece begins there, not at `from`
  Interval time;                 ///< the whole line where F cannot be told from 0 [s]
  double truncation{};           ///< how much narrower `time` would be with pieces shorter than this
};

class PeriodPieces {
 public:
  explicit PeriodPieces(EnergyBalance& energy) : energy_(energy) {}

  [[nodiscard]] PeriodPiece between(double from, double to);
  [[nodiscard]] PeriodPiece beside(const PeriodEnd& end, double to);
  /// Nothing where there is no place between its ends.
  [[nodiscard]] std::optional<std::array<PeriodPiece, 2>> halves(const PeriodPiece& piece);
  /// sqrt(A/(2 F)) on all of x.
  [[nodiscard]] Interval slowness(const Interval& x);

 private:
  EnergyBalance& energy_;
};

}  // namespace qdot
