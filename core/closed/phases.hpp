#pragma once
// Coordinates that stand in nothing but the sines and cosines of one phase, as x of a lattice's V cos(q x):
// motions are looked at by the phases, which are angles, and places told by the coordinates again.

#include <optional>

#include "core/closed/exact_values.hpp"
#include "core/closed/linear_motions.hpp"

namespace qdot {

struct ByPhases {
  LinearMotions motions;            ///< by the phases, where there are any
  std::vector<Interval> near;       ///< of what is x now
  std::vector<Replacement> phases;  ///< a phase's symbol, and what it is by its coordinate
  std::vector<Expression> x;        ///< the coordinates by what is x now
};

/// None where no coordinate without the unit of an angle has one. `values` know the place, of all of x.
[[nodiscard]] std::optional<ByPhases> by_phases(const LinearMotions& motions, const ExactValues& values,
                                                std::span<const Interval> near);

}  // namespace qdot
