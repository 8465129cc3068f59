#pragma once
// Periods of one coordinate with v^2 = e(x), to a few digits, wherever it may swing: what a formula says at
// parameters that nobody chose is held against them.
//
//   T = 2 integral dx/sqrt(e) = 2 integral r cos(u) du/sqrt(e),   x = c + r sin(u) between two ends,
//
// whose integrand is smooth where the ends are simple zeros of e, or walls.

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "core/numerics/constants.hpp"

namespace qdot {

struct SquaredSpeed {
  std::function<double(double)> at;  ///< e(x); not a number where there is none
  /// At two places, which takes little longer than at one.
  std::function<std::array<double, 2>(double, double)> at_both;
  double below{-infinity}, above{infinity};  ///< walls
  std::optional<double> start{};             ///< where the motion is, if it is known
  bool may_have_poles{true};                 ///< e may grow without bound at a place
  /// Whether a place that no motion passes is seen on a way that is looked at in so many pieces; empty: there
  /// is none.
  std::function<bool(double from, double to, int pieces)> meets_barrier{};
};

/// Whether one of the motions to and fro that are found, or the one from the start, has this period, or none
/// at all is found that moves.
[[nodiscard]] bool may_swing_with(const SquaredSpeed& e, double period);

/// Whether a turn of 2 pi takes this time, or there is a place that stops it.
[[nodiscard]] bool may_turn_with(const SquaredSpeed& e, double period);

/// The least of e on a way, and on the middle of it, next to what a parabola between its ends would have, and
/// to the largest.
struct Rooms {
  double on_the_way{infinity}, in_the_middle{infinity};
};

/// Of a motion that is at `from`, if e > 0 all the way to just before `to`, and it passes no pole.
[[nodiscard]] std::optional<Rooms> room_to_come(const SquaredSpeed& e, double from, double to);

}  // namespace qdot
