#pragma once
// How the state changes when a motion passes its kinks slightly earlier or later than computed.

#include <span>
#include <vector>

#include "core/motion/sided_motions.hpp"

namespace qdot {

/// The computation changed its forces at (t, y); the motion met the kinks a little before or after.
struct KinkPassage {
  std::vector<double> move;  ///< the error of y that comes of this
  double doubt{};            ///< the error of the instants of the kinks, in seconds
  double early{};     ///< their largest distance from t, in seconds: rows so near are on the wrong side
  bool is_hidden{};   ///< twice the digits do not show the instant either
  bool is_unclear{};  ///< the change of forces at one kink moves the next one by much
};

/// `before` and `after`: the sides of the kinks. `size`: for each kink, the size of the numbers whose sum is
/// its argument u. `duration`: of the section that ends at t. `move` is zero where a kink is hardly crossed,
/// or where rounding does not explain u and the section's series do not reach back to the instant.
[[nodiscard]] KinkPassage kink_passage(SidedMotions& motions, const Sides& before, const Sides& after,
                                       std::span<const double> size, double t, std::span<const double> y,
                                       double farthest);

}  // namespace qdot
