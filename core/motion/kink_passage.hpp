#pragma once
// What it comes to that a motion passes its kinks at slightly other instants than it was computed to.

#include <span>
#include <vector>

#include "core/motion/sided_motions.hpp"

namespace qdot {

/// A motion passed from one way to another at kinks that it met a little before or after (t, y), up to where
/// it went on by the old one.
struct KinkPassage {
  std::vector<double> move;  ///< what y is off by for that
  double doubt{};            ///< by how many seconds an instant may be elsewhere
  double early{};            ///< and by how many it was: rows so near to it are on the wrong side
  bool is_hidden{};          ///< twice the digits do not tell the instant either
  bool is_unclear{};         ///< forces between two of these kinks change the way to the next one by much
};

/// `size`: for each kink that of the numbers that make up u; `duration`: of the section that ends there.
/// Nothing is moved where an instant is farther back than the section's series tell, and not for rounding, or
/// hardly crossed. Looks from (t, y).
[[nodiscard]] KinkPassage kink_passage(SidedMotions& motions, const Sides& before, const Sides& after,
                                       std::span<const double> size, double t, std::span<const double> y,
                                       double farthest);

}  // namespace qdot
