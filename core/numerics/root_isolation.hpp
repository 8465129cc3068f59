#pragma once
// All zeros of n equations in n unknowns in a box, by branch and bound with interval arithmetic: boxes in
// which an equation cannot vanish are thrown away, the others contracted by Krawczyk's operator
// (krawczyk.hpp) or halved. So every zero of the region lies in what is returned, and each enclosure is a
// proven bound of its error. Source: Neumaier, Interval Methods for Systems of Equations (1990), 5.1; Moore,
// Kearfott, Cloud (2009), ch. 8.

#include <cstddef>
#include <span>
#include <vector>

#include "core/numerics/krawczyk.hpp"

namespace qdot {

struct IsolatedZero {
  Box enclosure;
  /// Proven to be one simple zero. Otherwise there may be any number of zeros, or a near miss: a multiple
  /// zero cannot be told from a pair in numbers of finite length.
  bool simple{};
  Box alone{};  ///< holds the enclosure and no other zero; empty where not simple
};

struct Isolation {
  std::vector<IsolatedZero> zeros;  ///< sorted by the first unknown that differs
  bool complete{true};  ///< false: given up after most_boxes or most of the work, zeros may be missing
  /// Too wide to be called one place: F may vanish anywhere there, as far as rounding lets one see.
  std::vector<Box> undecided;
  std::vector<Box> poles;  ///< F is not bounded even in the smallest boxes there
};

/// `region` must be wider than a point in each unknown; zeros on its edge count. `scales`: the size that
/// matters for each unknown where it is near zero (1 rad, 1 m); empty means 1.
[[nodiscard]] Isolation isolate_zeros(const SquareSystem& system, const Box& region,
                                      std::span<const double> scales = {}, std::size_t most_boxes = 50'000);

}  // namespace qdot
