#pragma once
// Which curves of equilibria come from an end of the region, as from infinity, or go there, between two
// values of the parameter: curves of one coordinate keep their order, so that it is the outermost.

#include <cstddef>
#include <span>
#include <vector>

#include "core/steady/region_ends.hpp"

namespace qdot {

struct CurvesAtEnds {
  std::vector<std::size_t> gone;  ///< of those before
  std::vector<std::size_t> come;  ///< of those after
};

/// x of the curves at the two values `low` and `high`, in any order. None where it is not told at which side
/// of its value some curve is there.
[[nodiscard]] CurvesAtEnds curves_at_ends(std::span<const EndCrossing> crossings, double low, double high,
                                          std::span<const double> before, std::span<const double> after);

}  // namespace qdot
